// voxtet itself, volume to tetrahedra, one thread: `peer_voxtet CASE.json OUT`. Leaves what the others start
// from: OUT.surface (surface_file.h) and OUT.nii, the labels to be meshed.
#include <algorithm>
#include <cstdio>

#include "base/digest.h"
#include "bench/peers/peer.h"
#include "bench/peers/surface_file.h"
#include "cli/input/case_input.h"
#include "io/bytes/files.h"
#include "io/volume/write_volume.h"
#include "pipeline/session.h"
#include "volume/mesh_order.h"

using namespace voxtet;

namespace {

Status run(Stage last, Session& session, double& seconds) {
  RunContext ctx;
  Status done = std::monostate{};
  seconds = peers::seconds_of([&] { done = session.run(last, ctx); });
  return done;
}

double peak_mb(const Session& session) {
  double peak = 0;
  for (int i = 0; i < kStageCount; ++i) peak = std::max(peak, session.record(static_cast<Stage>(i)).peak_mb);
  return peak;
}

Status leave_inputs(const Session& session, const std::string& out) {
  // As files store it: of the systole, mirrored, CGAL found no first point.
  AxisOrder order;
  order.reversed[0] = session.volume()->linear().determinant() < 0;
  const Result<Bytes> volume = write_nifti(reordered(*session.volume(), order), false);
  if (!volume) return volume.error();
  if (Status placed = place_files({{out + ".nii", *volume}}); !placed) return placed;
  return peers::write_fill_task({*session.remeshed(), *session.sizing()}, out + ".surface");
}

int fail(const Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "peer_voxtet: expected CASE.json OUT\n");
    return 2;
  }
  CaseOptions options;
  options.input = argv[1];
  const std::string out = argv[2];
  Session session;
  if (Status opened = open_case(options, session); !opened) return fail(opened.error());
  double surface_s = 0, fill_s = 0;
  Status done = std::monostate{};
  if (done = run(Stage::kRemesh, session, surface_s); !done) return fail(done.error());
  if (Status left = leave_inputs(session, out); !left) return fail(left.error());
  done = run(Stage::kOptimise, session, fill_s);
  nlohmann::json figures{{"surface_seconds", surface_s},
                         {"seconds", fill_s},
                         {"peak_mb", peak_mb(session)},
                         {"triangles", session.remeshed()->triangles.size()},
                         {"warnings", session.warnings()}};
  if (!done) {
    figures["error"] = done.error().message;
    return peers::finish(out, {}, figures);
  }
  figures["digest"] = digest_of(*session.mesh());
  return peers::finish(out, *session.mesh(), figures);
}
