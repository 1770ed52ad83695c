//: CONTRIBUTING.md struct Equation
