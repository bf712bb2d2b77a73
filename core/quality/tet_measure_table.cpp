#include "quality/tet_measure_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace voxtet {
namespace {

using Worst = MetricInfo::Worst;

double mean_edge(const TetShape& shape) {
  double sum = 0;
  for (const double edge : shape.edge_mm) sum += edge;
  return sum / 6;
}

/// The Jacobian's determinant over the largest product of the three edges at a corner, 1 for the regular
/// tetrahedron: Knupp, "Achieving finite element mesh quality via optimization of the Jacobian matrix norm
/// and associated quantities" (2000), as in Verdict. Negative where inverted, 0 where flat.
double scaled_jacobian(const TetShape& shape) {
  constexpr std::array<std::array<std::size_t, 3>, 4> kAtCorner{{{0, 1, 2}, {0, 3, 4}, {1, 3, 5}, {2, 4, 5}}};
  double largest = 0;
  for (const auto& [a, b, c] : kAtCorner)
    largest = std::max(largest, shape.edge_mm[a] * shape.edge_mm[b] * shape.edge_mm[c]);
  return largest > 0 ? std::sqrt(2.0) * 6 * shape.volume_mm3 / largest : 0;
}

constexpr std::array kMeasures{
    TetMeasure{"min_dihedral_deg", "Smallest dihedral angle", "deg", Scale::kSequential, Worst::kLowest, 0,
               75, false,
               [](const TetCorners&, const TetShape& shape, double) {
                 return *std::min_element(shape.dihedral_deg.begin(), shape.dihedral_deg.end());
               }},
    TetMeasure{"max_dihedral_deg", "Largest dihedral angle", "deg", Scale::kSequential, Worst::kHighest, 60,
               180, false,
               [](const TetCorners&, const TetShape& shape, double) {
                 return *std::max_element(shape.dihedral_deg.begin(), shape.dihedral_deg.end());
               }},
    TetMeasure{"radius_ratio", "Radius ratio", "1", Scale::kSequential, Worst::kLowest, 0, 1, false,
               [](const TetCorners&, const TetShape& shape, double) { return shape.radius_ratio; }},
    TetMeasure{"mean_ratio", "Mean ratio", "1", Scale::kSequential, Worst::kLowest, 0, 1, false,
               [](const TetCorners&, const TetShape& shape, double) { return shape.mean_ratio; }},
    TetMeasure{"aspect_ratio", "Aspect ratio", "1", Scale::kSequential, Worst::kHighest, 1, 6, false,
               [](const TetCorners&, const TetShape& shape, double) { return shape.aspect_ratio; }},
    TetMeasure{"scaled_jacobian", "Scaled Jacobian", "1", Scale::kSequential, Worst::kLowest, 0, 1, false,
               [](const TetCorners&, const TetShape& shape, double) { return scaled_jacobian(shape); }},
    TetMeasure{"edge_mm", "Mean edge length", "mm", Scale::kSequential, Worst::kNone, 0, 0, false,
               [](const TetCorners&, const TetShape& shape, double) { return mean_edge(shape); }},
    TetMeasure{"target_mm", "Target edge length", "mm", Scale::kSequential, Worst::kNone, 0, 0, true,
               [](const TetCorners&, const TetShape&, double target_mm) { return target_mm; }},
    TetMeasure{"size_log2", "Edge length over target", "log2", Scale::kDiverging, Worst::kNone, 0, 0, true,
               [](const TetCorners&, const TetShape& shape, double target_mm) {
                 return std::log2(mean_edge(shape) / target_mm);
               }},
};

}  // namespace

std::span<const TetMeasure> tet_measures() {
  return kMeasures;
}

std::vector<Field> measure_tets(const TetMesh& mesh, const SizingField* sizing, int threads,
                                std::vector<float>* all_angles) {
  std::vector<const TetMeasure*> rows;
  std::vector<Field> fields;
  for (const TetMeasure& row : kMeasures) {
    if (row.of_target && !sizing) continue;
    rows.push_back(&row);
    fields.push_back(
        {row.name, row.title, row.unit, On::kTets, row.scale, 1, std::vector<float>(mesh.tets.size())});
  }
  if (all_angles) all_angles->resize(6 * mesh.tets.size());
  const auto measure = [&](std::size_t i) {
    const auto [a, b, c, d] = mesh.tets[i];
    const TetCorners corners{mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]};
    const TetShape shape = measure_tet(corners);
    const Eigen::Vector3d centre = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
    const double target =
        sizing && centre.allFinite() ? sizing->at(centre) : std::numeric_limits<double>::quiet_NaN();
    for (std::size_t row = 0; row < rows.size(); ++row)
      fields[row].values[i] = static_cast<float>(rows[row]->of(corners, shape, target));
    if (!all_angles) return;
    for (std::size_t k = 0; k < 6; ++k) (*all_angles)[6 * i + k] = static_cast<float>(shape.dihedral_deg[k]);
  };
  parallel_for(threads, mesh.tets.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) measure(i);
  });
  return fields;
}

}  // namespace voxtet
