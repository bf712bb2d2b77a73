// Every promise of extraction and smoothing on seeded random label volumes.
#include <gtest/gtest.h>

#include "base/digest.h"
#include "geometry/intersect/self_intersections.h"
#include "support/check_surface.h"
#include "support/random_labels.h"
#include "support/surface_labels.h"
#include "surface/extract/extract_surface.h"
#include "surface/smooth/smooth_surface.h"

namespace voxtet {
namespace {

TEST(RandomVolumes, StayClosedFreeOfIntersectionsAndOnTheSideOfHeldVoxels) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const test::RandomLabels random = test::random_labels(seed);
    SCOPED_TRACE(std::to_string(seed) + " " + random.kind + " " + random.affine);
    RunContext ctx;
    const SurfaceMesh raw = extract_surface(random.volume, {}, ctx).value();
    ASSERT_TRUE(test::is_valid_surface(raw));
    ASSERT_TRUE(find_self_intersections(raw, 1).empty());
    const Result<SurfaceMesh> smooth = smooth_surface(raw, random.volume, {}, ctx);
    ASSERT_TRUE(smooth.ok()) << smooth.error().message;
    ASSERT_TRUE(test::is_valid_surface(*smooth));
    ASSERT_TRUE(find_self_intersections(*smooth, 1).empty());
    const test::ChangedVoxels changed = test::changed_voxels(*smooth, random.volume);
    ASSERT_EQ(changed.inner, 0U);
    ASSERT_EQ(changed.thin, 0U);
  }
}

TEST(RandomVolumes, GiveTheSameBytesForAnyNumberOfThreads) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const LabelVolume volume = test::random_labels(seed).volume;
    for (const ExtractMethod method : {ExtractMethod::kMarchingCubes, ExtractMethod::kMarchingTets}) {
      RunContext ctx;
      ExtractParams params;
      params.method = method;
      const SurfaceMesh raw = extract_surface(volume, params, ctx).value();
      const auto smooth_digest = [&] { return digest_of(smooth_surface(raw, volume, {}, ctx).value()); };
      const std::string smooth = smooth_digest();
      for (const int threads : {2, 3, 40}) {
        ctx.threads = threads;
        ASSERT_EQ(digest_of(extract_surface(volume, params, ctx).value()), digest_of(raw)) << seed;
        if (threads == 3) {
          ASSERT_EQ(smooth_digest(), smooth) << seed;
        }
      }
      ctx.threads = 1;
    }
  }
}

}  // namespace
}  // namespace voxtet
