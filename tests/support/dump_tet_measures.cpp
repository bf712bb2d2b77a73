// dump_tet_measures < corners > measures: twelve doubles a tetrahedron in; volume, six edges, six dihedral
// angles, radius ratio, mean ratio and aspect ratio out. For tests/integration/quality_vtk.py.
#include <array>
#include <cstdio>

#include "geometry/elements/tet_measures.h"

int main() {
  std::array<double, 12> in{};
  while (std::fread(in.data(), sizeof(double), in.size(), stdin) == in.size()) {
    voxtet::TetCorners corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = {in[3 * i], in[3 * i + 1], in[3 * i + 2]};
    const voxtet::TetShape shape = voxtet::measure_tet(corners);
    std::array<double, 16> out{};
    out[0] = shape.volume_mm3;
    for (std::size_t e = 0; e < 6; ++e) {
      out[1 + e] = shape.edge_mm[e];
      out[7 + e] = shape.dihedral_deg[e];
    }
    out[13] = shape.radius_ratio;
    out[14] = shape.mean_ratio;
    out[15] = shape.aspect_ratio;
    if (std::fwrite(out.data(), sizeof(double), out.size(), stdout) != out.size()) return 1;
  }
  return 0;
}
