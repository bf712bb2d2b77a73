#include "tetra/optimise_tets.h"

#include <algorithm>
#include <queue>
#include <string>
#include <vector>

#include "tetra/edge_removal.h"
#include "tetra/face_removal.h"
#include "tetra/tet_complex.h"
#include "tetra/vertex_insertion.h"
#include "tetra/vertex_smoothing.h"
#include "tetra/wall_sliding.h"

namespace voxtet {
namespace {

using namespace tetra;

constexpr int kSmoothingSteps = 5;

class Optimiser {
 public:
  Optimiser(TetMesh mesh, const SurfaceMesh& reference, const SizingField& sizing, const OptimiseParams& params)
      : complex_(std::move(mesh)),
        guard_(sizing),
        smoother_(complex_, guard_),
        inserter_(complex_, guard_),
        slider_(complex_, smoother_, reference),
        goal_(quality_of_angle(params.min_dihedral_deg)),
        insertion_goal_(quality_of_angle(params.insertion_deg)) {}

  void swap_pass() {
    Queue queue = bad_tets(goal_);
    while (!queue.empty()) {
      const auto [quality, t] = queue.top();
      queue.pop();
      if (!complex_.alive(t) || complex_.quality_of(t) != quality) continue;
      if (swap(t)) requeue(queue, goal_);
    }
  }
  void smooth_pass() {
    Queue queue = bad_tets(goal_);
    seen_.assign(complex_.point_count(), 0);
    while (!queue.empty()) {
      const std::uint32_t t = queue.top().second;
      queue.pop();
      for (const std::uint32_t v : complex_.corners(t)) {
        if (complex_.on_wall(v) || seen_[v]) continue;
        seen_[v] = 1;
        smoothed += smoother_.smooth(v, kSmoothingSteps);
      }
    }
  }
  void insert_pass() {
    Queue queue = bad_tets(insertion_goal_);
    while (!queue.empty()) {
      const auto [quality, t] = queue.top();
      queue.pop();
      if (!complex_.alive(t) || complex_.quality_of(t) != quality) continue;
      if (!inserter_.insert(t)) continue;
      ++inserted;
      requeue(queue, insertion_goal_);
    }
  }
  void slide_pass(double goal) {
    Queue queue = bad_tets(goal);
    seen_.assign(complex_.point_count(), 0);
    std::vector<std::uint32_t> vertices;
    while (!queue.empty()) {
      const std::uint32_t t = queue.top().second;
      queue.pop();
      for (const std::uint32_t v : complex_.corners(t)) {
        if (!complex_.on_wall(v) || seen_[v]) continue;
        seen_[v] = 1;
        vertices.push_back(v);
      }
    }
    slid += slider_.slide(vertices);
  }
  TetMesh release() { return std::move(complex_).release(); }
  double lowest() const {
    double q = 1;
    for (std::uint32_t t = 0; t < complex_.places(); ++t)
      if (complex_.alive(t)) q = std::min(q, complex_.quality_of(t));
    return q;
  }
  std::size_t edges = 0, faces = 0, smoothed = 0, inserted = 0, slid = 0;

 private:
  using Entry = std::pair<double, std::uint32_t>;
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

  Queue bad_tets(double goal) const {
    std::vector<Entry> bad;
    for (std::uint32_t t = 0; t < complex_.places(); ++t)
      if (complex_.alive(t) && complex_.quality_of(t) < goal) bad.push_back({complex_.quality_of(t), t});
    return Queue(std::greater<>{}, std::move(bad));
  }
  void requeue(Queue& queue, double goal) const {
    for (const std::uint32_t t : complex_.made())
      if (complex_.quality_of(t) < goal) queue.push({complex_.quality_of(t), t});
  }
  bool swap(std::uint32_t t) {
    for (std::uint32_t i = 0; i < 4; ++i)
      for (std::uint32_t j = 0; j < i; ++j)
        if (remove_edge(complex_, t, i, j, guard_)) return ++edges;
    for (std::uint32_t c = 0; c < 4; ++c)
      if (remove_faces(complex_, t, c, guard_)) return ++faces;
    return false;
  }

  TetComplex complex_;
  SizeGuard guard_;
  VertexSmoother smoother_;
  VertexInserter inserter_;
  WallSlider slider_;
  double goal_, insertion_goal_;
  std::vector<std::uint8_t> seen_;
};

}  // namespace

Result<TetMesh> optimise_tets(TetMesh mesh, const SurfaceMesh& reference, const SizingField& sizing,
                              const OptimiseParams& params, RunContext& ctx) {
  Optimiser o(std::move(mesh), reference, sizing, params);
  for (int round = 0; round < params.rounds; ++round) {
    o.swap_pass();
    double a = o.lowest();
    o.smooth_pass();
    double b = o.lowest();
    if (round > 0) o.insert_pass();
    double c = o.lowest();
    if (round > 0) o.slide_pass(quality_of_angle(getenv("SL")?atof(getenv("SL")):31));
    char text[200];
    snprintf(text, 200, "round %d: swap %.4f smooth %.4f insert %.4f slide %.4f; edges %zu faces %zu smoothed %zu inserted %zu slid %zu", round, a, b, c, o.lowest(), o.edges, o.faces, o.smoothed, o.inserted, o.slid);
    ctx.note("optimise", text);
  }
  return o.release();
}

}  // namespace voxtet
