#pragma once

#include <gtest/gtest.h>

#include "phantom/make_phantom.h"

namespace voxtet {

/// The phantom, which must succeed.
inline LabelVolume heart(const PhantomParams& params) {
  const Result<LabelVolume> volume = make_phantom(params);
  EXPECT_TRUE(volume.ok()) << (volume ? "" : volume.error().message);
  return volume ? *volume : LabelVolume{};
}

}  // namespace voxtet
