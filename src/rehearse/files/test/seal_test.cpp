#include "rehearse/files/seal.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/test/test_tools.hpp"

namespace rehearse::files {
namespace {

TEST(Seal, TellsWhatIsWhole) {
  const std::string sealed = seal("kept", "body");
  EXPECT_EQ(unseal("kept", sealed), "body");
  const auto refusal = [](std::string_view kind, std::string_view bytes) {
    return message_of<InvalidInput>([&] { unseal(kind, bytes); });
  };
  EXPECT_EQ(refusal("kept", sealed.substr(0, sealed.size() - 1)), "the kept is truncated or damaged");
  EXPECT_EQ(refusal("checkpoint", sealed), "the checkpoint is truncated or not one of Rehearse");
  EXPECT_NE(refusal("kept", "rehearse-kept 7 1 0\nx").find("has format 7"), std::string::npos);
}

TEST(Seal, AnyByteThatChangesIsNoticed) {
  const std::string body("two\0lines\n", 10), sealed = seal("kept", body);
  EXPECT_EQ(unseal("kept", sealed), body);
  EXPECT_EQ(unseal("kept", seal("kept", "")), "");
  for (std::size_t i = 0; i < sealed.size(); ++i) {
    std::string changed = sealed;
    changed[i] ^= 1;
    EXPECT_THROW(unseal("kept", changed), InvalidInput) << i;
  }
  EXPECT_THROW(unseal("kept", sealed + "x"), InvalidInput);
  EXPECT_THROW(unseal("kept", ""), InvalidInput);
}

}  // namespace
}  // namespace rehearse::files
