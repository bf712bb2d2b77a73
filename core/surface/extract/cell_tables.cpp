#include "surface/extract/cell_tables.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace voxtet {
namespace {

using Int3 = std::array<int, 3>;

int edge_between(unsigned a, unsigned b) {
  for (std::size_t e = 0; e < CubeTable::kEdges.size(); ++e) {
    const CellEdge& edge = CubeTable::kEdges[e];
    if (edge.top == std::max(a, b) && edge.direction == (a ^ b)) return static_cast<int>(e);
  }
  return -1;
}

/// Midpoint of a cell edge in half cells: coordinates 0, 1 or 2.
Int3 doubled_midpoint(int e) {
  const CellEdge& edge = CubeTable::kEdges[static_cast<std::size_t>(e)];
  Int3 p{};
  for (int d = 0; d < 3; ++d)
    p[static_cast<std::size_t>(d)] = ((edge.top >> d) & 1) + (((edge.top ^ edge.direction) >> d) & 1);
  return p;
}

/// Four corners of a cell face, counter-clockwise seen from outside.
std::array<unsigned, 4> face_corners(int axis, int side) {
  const unsigned u = 1U << ((axis + 1) % 3), v = 1U << ((axis + 2) % 3);
  const unsigned base = side ? 1U << axis : 0U;
  if (side) return {base, base | u, base | u | v, base | v};
  return {base, base | v, base | u | v, base | u};
}

/// For each crossed edge the next one along its loop: every face adds a segment around each run of
/// foreground.
std::array<int, 12> trace_segments(unsigned mask) {
  std::array<int, 12> next{};
  next.fill(-1);
  const auto inside = [mask](unsigned corner) { return ((mask >> corner) & 1) != 0; };
  for (int face = 0; face < 6; ++face) {
    const std::array<unsigned, 4> c = face_corners(face / 2, face % 2);
    for (std::size_t i = 0; i < 4; ++i) {
      if (inside(c[i]) || !inside(c[(i + 1) % 4])) continue;
      std::size_t last = (i + 1) % 4;
      while (inside(c[(last + 1) % 4])) last = (last + 1) % 4;
      next[static_cast<std::size_t>(edge_between(c[i], c[(i + 1) % 4]))] =
          edge_between(c[last], c[(last + 1) % 4]);
    }
  }
  return next;
}

/// Squared length of a diagonal; prohibitive where it lies in a cell face, since the neighbouring cell may
/// draw the same one and four triangles would meet there.
int diagonal_cost(int a, int b) {
  const Int3 p = doubled_midpoint(a), q = doubled_midpoint(b);
  int squared = 0;
  bool in_face = false;
  for (std::size_t d = 0; d < 3; ++d) {
    squared += (p[d] - q[d]) * (p[d] - q[d]);
    in_face = in_face || (p[d] == q[d] && p[d] != 1);
  }
  return in_face ? 1'000'000 : squared;
}

/// Cheapest triangulation of loop[from..to], whose closing edge from-to exists already.
int triangulate(const std::vector<int>& loop, std::size_t from, std::size_t to,
                std::vector<std::array<std::uint8_t, 3>>& out) {
  if (to < from + 2) return 0;
  int best = std::numeric_limits<int>::max();
  std::vector<std::array<std::uint8_t, 3>> best_triangles;
  for (std::size_t apex = from + 1; apex < to; ++apex) {
    std::vector<std::array<std::uint8_t, 3>> trial{{static_cast<std::uint8_t>(loop[from]),
                                                    static_cast<std::uint8_t>(loop[apex]),
                                                    static_cast<std::uint8_t>(loop[to])}};
    int cost = 0;
    if (apex > from + 1) cost += diagonal_cost(loop[from], loop[apex]);
    if (to > apex + 1) cost += diagonal_cost(loop[apex], loop[to]);
    cost += triangulate(loop, from, apex, trial);
    cost += triangulate(loop, apex, to, trial);
    if (cost < best) {
      best = cost;
      best_triangles = trial;
    }
  }
  out.insert(out.end(), best_triangles.begin(), best_triangles.end());
  return best;
}

/// Corners of a right-handed Kuhn tetrahedron (0, x, xy, xyz) in twelfths of a cell.
constexpr std::array<Int3, 4> kChain{{{0, 0, 0}, {12, 0, 0}, {12, 12, 0}, {12, 12, 12}}};

/// Position of a vertex of TetTriangle in that tetrahedron, in twelfths of a cell.
Int3 tet_position(unsigned vertex) {
  unsigned used = 0xF;
  if (vertex < 6) used = (1U << kTetEdges[vertex][0]) | (1U << kTetEdges[vertex][1]);
  if (vertex >= 6 && vertex < 10) used = 0xFU ^ (1U << (vertex - 6));
  Int3 sum{};
  int count = 0;
  for (unsigned c = 0; c < 4; ++c) {
    if (!((used >> c) & 1)) continue;
    ++count;
    for (std::size_t d = 0; d < 3; ++d) sum[d] += kChain[c][d];
  }
  for (int& x : sum) x /= count;
  return sum;
}

Int3 minus(const Int3& a, const Int3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Turns the triangle so that its normal points from corner `behind` to corner `front`.
TetTriangle oriented(TetTriangle t) {
  const Int3 a = tet_position(t.vertices[0]);
  const Int3 u = minus(tet_position(t.vertices[1]), a), v = minus(tet_position(t.vertices[2]), a);
  const Int3 w = minus(kChain[t.front], kChain[t.behind]);
  const int det = w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
                  w[2] * (u[0] * v[1] - u[1] * v[0]);
  if (det < 0) std::swap(t.vertices[1], t.vertices[2]);
  return t;
}

std::uint8_t tet_edge(unsigned a, unsigned b) {
  for (std::uint8_t e = 0; e < 6; ++e)
    if (kTetEdges[e][0] == std::min(a, b) && kTetEdges[e][1] == std::max(a, b)) return e;
  return 0;
}

void add_quad(const std::array<std::uint8_t, 4>& q, unsigned behind, unsigned front,
              std::vector<TetTriangle>& out) {
  const auto length = [](std::uint8_t a, std::uint8_t b) {
    const Int3 d = minus(tet_position(a), tet_position(b));
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  };
  const auto b = static_cast<std::uint8_t>(behind), f = static_cast<std::uint8_t>(front);
  if (length(q[0], q[2]) <= length(q[1], q[3])) {
    out.push_back(oriented({{q[0], q[1], q[2]}, b, f}));
    out.push_back(oriented({{q[0], q[2], q[3]}, b, f}));
  } else {
    out.push_back(oriented({{q[1], q[2], q[3]}, b, f}));
    out.push_back(oriented({{q[1], q[3], q[0]}, b, f}));
  }
}

/// Triangles between two groups of equally labelled corners; `rest` are the corners of neither.
void add_interface(const std::vector<unsigned>& g, const std::vector<unsigned>& h,
                   const std::vector<unsigned>& rest, bool rest_is_one_label, std::vector<TetTriangle>& out) {
  const auto face = [](unsigned opposite) { return static_cast<std::uint8_t>(6 + opposite); };
  const auto b = static_cast<std::uint8_t>(g[0]), f = static_cast<std::uint8_t>(h[0]);
  if (g.size() + h.size() == 4) {
    if (g.size() == 2) {
      add_quad({tet_edge(g[0], h[0]), tet_edge(g[1], h[0]), tet_edge(g[1], h[1]), tet_edge(g[0], h[1])}, b, f,
               out);
      return;
    }
    const std::vector<unsigned>& three = g.size() == 3 ? g : h;
    const unsigned one = g.size() == 3 ? h[0] : g[0];
    out.push_back(
        oriented({{tet_edge(three[0], one), tet_edge(three[1], one), tet_edge(three[2], one)}, b, f}));
  } else if (g.size() + h.size() == 3) {  // 2+1 of 2+1+1: the third label is the one corner of `rest`
    const std::vector<unsigned>& two = g.size() == 2 ? g : h;
    const unsigned one = g.size() == 2 ? h[0] : g[0];
    add_quad({tet_edge(two[0], one), tet_edge(two[1], one), face(two[0]), face(two[1])}, b, f, out);
  } else if (rest_is_one_label) {  // 1+1 of 2+1+1
    out.push_back(oriented({{tet_edge(g[0], h[0]), face(rest[0]), face(rest[1])}, b, f}));
  } else {  // 1+1 of 1+1+1+1
    add_quad({tet_edge(g[0], h[0]), face(rest[0]), 10, face(rest[1])}, b, f, out);
  }
}

/// Labels 0..3 of the corners such that exactly the edges of `code` join different ones; false if there are
/// none.
bool labels_of(unsigned code, std::array<unsigned, 4>& label) {
  unsigned count = 0;
  for (unsigned c = 0; c < 4; ++c) {
    label[c] = count;
    for (unsigned before = 0; before < c; ++before)
      if (!((code >> tet_edge(before, c)) & 1)) label[c] = std::min(label[c], label[before]);
    if (label[c] == count) ++count;
  }
  for (unsigned e = 0; e < 6; ++e)
    if (((code >> e) & 1) != (label[kTetEdges[e][0]] != label[kTetEdges[e][1]])) return false;
  return true;
}

}  // namespace

CubeTable::CubeTable() {
  for (unsigned mask = 0; mask < 256; ++mask) {
    first_[mask] = triangles_.size();
    std::array<int, 12> next = trace_segments(mask);
    for (std::size_t start = 0; start < 12; ++start) {
      std::vector<int> loop;
      for (std::size_t e = start; next[e] >= 0;) {
        loop.push_back(static_cast<int>(e));
        e = static_cast<std::size_t>(std::exchange(next[e], -1));
      }
      if (!loop.empty()) triangulate(loop, 0, loop.size() - 1, triangles_);
    }
  }
  first_[256] = triangles_.size();
}

TetTable::TetTable() {
  for (unsigned code = 0; code < 64; ++code) {
    first_[code] = triangles_.size();
    std::array<unsigned, 4> label{};
    if (!labels_of(code, label)) continue;
    std::array<std::vector<unsigned>, 4> groups;
    for (unsigned c = 0; c < 4; ++c) groups[label[c]].push_back(c);
    for (unsigned a = 0; a < 4; ++a)
      for (unsigned b = a + 1; b < 4; ++b) {
        if (groups[a].empty() || groups[b].empty()) continue;
        std::vector<unsigned> rest;
        for (unsigned c = 0; c < 4; ++c)
          if (label[c] != a && label[c] != b) rest.push_back(c);
        const bool rest_is_one_label = rest.size() == 2 && label[rest[0]] == label[rest[1]];
        add_interface(groups[a], groups[b], rest, rest_is_one_label, triangles_);
      }
  }
  first_[64] = triangles_.size();
}

const CubeTable& cube_table() {
  static const CubeTable table;
  return table;
}

const TetTable& tet_table() {
  static const TetTable table;
  return table;
}

}  // namespace voxtet
