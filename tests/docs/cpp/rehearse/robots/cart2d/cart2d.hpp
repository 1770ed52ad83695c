//: CONTRIBUTING.md #pragma once
