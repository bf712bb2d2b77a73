#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "physics/beat/heart_steps.h"
#include "physics/beat/make_heart.h"
#include "support/ellipsoid.h"

namespace voxtet::beat {
namespace {

TEST(Beat, Runs) {
  const test::HeartBody body = test::left_ventricle(1, 10, {20, 29, 45, 54, 10});
  Fibres fibres;
  const test::Ellipsoid shape{20, 29, 45, 54, 10};
  for (std::size_t t = 0; t < body.mesh.tets.size(); ++t) {
    const Eigen::Vector3d c = body.centroid(t);
    const double a = (60 - 120 * shape.depth(c)) * EIGEN_PI / 180;
    const Eigen::Vector3d f = shape.fibre(c, a), across = shape.fibre(c, a + EIGEN_PI / 2);
    fibres.fibre.push_back(f);
    fibres.sheet.push_back(f.cross(across));
  }
  const std::vector<bool> right(body.mesh.tets.size(), false);
  BeatParams params;
  params.contraction.by = ActivationBy::kSynchronous;
  auto made = make_heart({body.mesh, body.surfaces, fibres, right, {}}, params);
  ASSERT_TRUE(made.ok()) << made.error().message;
  auto steps = HeartSteps::start(made->heart, made->start, {});
  ASSERT_TRUE(steps.ok()) << steps.error().message;
  std::printf("tets %zu unknowns %td\n", body.mesh.tets.size(), made->heart->body.unknowns());
  const auto t0 = std::chrono::steady_clock::now();
  while (steps->now().time_s < 0.8 - 1e-9) {
    const auto done = steps->advance();
    ASSERT_TRUE(done.ok()) << done.error().message;
    if (*done && steps->steps() % 8 == 0)
      std::printf("%7.1f ms step %.4f V %7.2f ml p %6.2f kPa art %6.2f newton %d gmres %d lu %d t %.1f\n",
                  1000 * steps->now().time_s, 1000 * steps->step_s(), steps->now().cavity_ml[0],
                  steps->now().cavity_kpa[0], steps->now().circulation[0], steps->newton_iterations(),
                  steps->linear_iterations(), steps->factorisations(),
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count());
  }
}

}  // namespace
}  // namespace voxtet::beat
