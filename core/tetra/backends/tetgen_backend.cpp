#include "tetra/backends/tetgen_backend.h"

#include <tetgen.h>

#include <exception>
#include <new>
#include <string>

#include "tetra/mesh/meshing_error.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

/// A tetrahedron is split when its circumradius exceeds this many times the target edge length. Measured, so
/// that the median of log2(edge / target) over inner edges is 0 (within 0.05 on spheres, shells, boxes,
/// graded nested spheres).
constexpr double kRadiusPerEdge = 0.79;

constexpr int kCancelledCode = 100;
constexpr int kRunawayCode = 101;
constexpr const char* kRunaway = "TetGen was stopped: its refinement did not come to an end";
/// An ordinary run polls 57 times for each point it ends with, be it graded or uniform.
constexpr long long kMaxPollsPerPoint = 60;
constexpr int kPollsPerQuestion = 512;

struct Job {
  const SizingField* sizing = nullptr;
  const RunContext* ctx = nullptr;
  long first_points = 0;
  long long max_points = 0;
  long long polls = 0;
};

double largest_circumradius(void* data, const double* point) {
  const Job& job = *static_cast<const Job*>(data);
  return kRadiusPerEdge * job.sizing->at({point[0], point[1], point[2]});
}

int poll(void* data, long points) {
  Job& job = *static_cast<Job*>(data);
  if (points > job.max_points || job.polls / kMaxPollsPerPoint > job.max_points) return kRunawayCode;
  if (++job.polls % kPollsPerQuestion != 0) return 0;
  if (job.ctx->cancelled()) return kCancelledCode;
  // How many points will be needed is not known: the share of new ones grows towards its end.
  const double added = static_cast<double>(points - job.first_points);
  if (added > 0) job.ctx->progress(kTetraStage, added / static_cast<double>(points + job.first_points));
  return 0;
}

/// The surface as TetGen's input: one facet of one polygon per triangle, in flat arrays that stay ours.
class Input {
 public:
  Input(const SurfaceMesh& surface, const std::vector<Eigen::Vector3d>& hole_seeds) : holes_(hole_seeds) {
    io.firstnumber = 0;
    io.numberofpoints = static_cast<int>(surface.points.size());
    points_ = surface.points;
    io.pointlist = points_.data()->data();
    corners_.reserve(3 * surface.triangles.size());
    for (const Triangle& triangle : surface.triangles)
      for (const std::uint32_t v : triangle) corners_.push_back(static_cast<int>(v));
    polygons_.resize(surface.triangles.size());
    facets_.resize(surface.triangles.size());
    for (std::size_t t = 0; t < facets_.size(); ++t) {
      tetgenio::init(&polygons_[t]);
      polygons_[t].vertexlist = &corners_[3 * t];
      polygons_[t].numberofvertices = 3;
      tetgenio::init(&facets_[t]);
      facets_[t].polygonlist = &polygons_[t];
      facets_[t].numberofpolygons = 1;
    }
    io.facetlist = facets_.data();
    io.numberoffacets = static_cast<int>(facets_.size());
    if (!holes_.empty()) io.holelist = holes_.data()->data();
    io.numberofholes = static_cast<int>(holes_.size());
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;
  ~Input() {
    // tetgenio would delete what it points to.
    io.pointlist = nullptr;
    io.holelist = nullptr;
    io.facetlist = nullptr;
    io.numberoffacets = 0;
  }

  tetgenio io;

 private:
  std::vector<Eigen::Vector3d> points_, holes_;
  std::vector<int> corners_;
  std::vector<tetgenio::polygon> polygons_;
  std::vector<tetgenio::facet> facets_;
};

tetgenbehavior behaviour(const TetgenOptions& options) {
  tetgenbehavior b;
  b.plc = 1;           // -p
  b.nobisect = 1;      // -Y
  b.regionattrib = 1;  // -A
  b.quality = 1;       // -q
  b.minratio = options.radius_edge;
  b.mindihedral = options.min_dihedral_deg;
  if (options.max_dihedral_deg > 0) b.optmaxdihedral = options.max_dihedral_deg;  // -o/
  b.epsilon = options.tolerance;                                                  // -T
  b.nobound = 1;                                                                  // -B
  b.nofacewritten = 1;                                                            // -F
  b.quiet = 1;                                                                    // -Q
  return b;
}

Error error_of(int thrown) {
  switch (thrown) {
    case kCancelledCode: return cancelled_error(kTetraStage);
    case kRunawayCode: return meshing_error(kRunaway);
    case 1:
      return {ErrorCode::kOutOfMemory,
              kTetraStage,
              "memory ran out while filling the surface with tetrahedra",
              {}};
    case 3: return meshing_error("TetGen met a self-intersection of the surface");
    case 4: return meshing_error("TetGen met a feature smaller than its tolerance");
    case 5: return meshing_error("TetGen met two triangles that nearly coincide");
    case 10: return meshing_error("TetGen refused the surface as its input");
    default: return meshing_error("TetGen failed inside (code " + std::to_string(thrown) + ")");
  }
}

FilledParts take(const tetgenio& out) {
  FilledParts mesh;
  mesh.points.resize(static_cast<std::size_t>(out.numberofpoints));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    mesh.points[i] = Eigen::Vector3d::Map(out.pointlist + 3 * i);
  const std::size_t tets = static_cast<std::size_t>(out.numberoftetrahedra);
  mesh.tets.resize(tets);
  mesh.regions.resize(tets);
  for (std::size_t t = 0; t < tets; ++t) {
    for (std::size_t c = 0; c < 4; ++c)
      mesh.tets[t][c] = static_cast<std::uint32_t>(out.tetrahedronlist[4 * t + c]);
    mesh.regions[t] = static_cast<std::uint32_t>(out.tetrahedronattributelist[t]);
  }
  return mesh;
}

}  // namespace

Result<FilledParts> run_tetgen(const SurfaceMesh& surface, const std::vector<Eigen::Vector3d>& hole_seeds,
                               const SizingField& sizing, const TetgenOptions& options,
                               const RunContext& ctx) {
  try {
    Job job{&sizing, &ctx, static_cast<long>(surface.points.size()),
            static_cast<long long>(options.max_points), 0};
    tetgenio out;
    {
      Input in(surface, hole_seeds);
      in.io.callbackdata = &job;
      in.io.edgelength = largest_circumradius;
      in.io.poll = poll;
      tetgenbehavior switches = behaviour(options);
      tetrahedralize(&switches, &in.io, &out);
    }
    if (out.numberoftetrahedra == 0 || out.numberoftetrahedronattributes != 1)
      return meshing_error("TetGen gave no tetrahedra");
    return take(out);
  } catch (int thrown) {
    return error_of(thrown);
  } catch (const std::bad_alloc&) {
    return error_of(1);
  } catch (const std::exception& e) {
    return Error{ErrorCode::kInternal, kTetraStage, std::string("TetGen threw: ") + e.what(), {}};
  }
}

bool is_runaway(const Error& error) {
  return error.code == ErrorCode::kMeshing && error.message == kRunaway;
}

}  // namespace voxtet
