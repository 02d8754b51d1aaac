#include "base/errors.hpp"

#include <gtest/gtest.h>

namespace mortise {
namespace {

TEST(UnknownName, IsToldWithTheNearestAndAllThatAreKnown) {
  EXPECT_EQ(unknown_name("body", "plat", {"plate", "disc"}),
            "unknown body 'plat'; did you mean 'plate'? known: plate, disc");
  EXPECT_EQ(unknown_name("body", "ring", {"plate", "disc"}), "unknown body 'ring'; known: plate, disc");
  EXPECT_EQ(unknown_name("boundary", "top", {}), "unknown boundary 'top'; there is none");
}

}  // namespace
}  // namespace mortise
