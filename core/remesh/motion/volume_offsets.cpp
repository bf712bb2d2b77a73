#include "remesh/motion/volume_offsets.h"

#include <algorithm>

namespace voxtet::remesh {

std::vector<double> volume_offsets(const std::vector<Sides>& pairs, const std::vector<double>& areas_mm2,
                                   const std::vector<double>& lacking_mm3, double most_mm) {
  constexpr int kSweeps = 200;  // of damped Jacobi; the system is the graph Laplacian of the labels
  const std::size_t count = lacking_mm3.size();
  std::vector<double> offsets(pairs.size(), 0), lambda(count, 0), sums(count), weights(count);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t l = 0; l < sums.size(); ++l) {
      sums[l] = lacking_mm3[l];
      weights[l] = 0;
    }
    for (std::size_t pair = 0; pair < pairs.size(); ++pair)
      for (const std::size_t end : {0, 1}) {
        sums[pairs[pair][end]] += areas_mm2[pair] * lambda[pairs[pair][1 - end]];
        weights[pairs[pair][end]] += areas_mm2[pair];
      }
    for (std::size_t l = 1; l < lambda.size(); ++l)
      if (weights[l] > 0) lambda[l] = 0.5 * (lambda[l] + sums[l] / weights[l]);
  }
  for (std::size_t pair = 0; pair < pairs.size(); ++pair)
    offsets[pair] = std::clamp(lambda[pairs[pair][0]] - lambda[pairs[pair][1]], -most_mm, most_mm);
  return offsets;
}

}  // namespace voxtet::remesh
