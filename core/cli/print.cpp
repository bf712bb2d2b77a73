#include "cli/print.h"

#include <chrono>
#include <memory>
#include <string>

#include "cli/cli.h"

#if !defined(__EMSCRIPTEN__)
#include <unistd.h>
#endif

namespace voxtet {
namespace {

using Clock = std::chrono::steady_clock;

bool on_terminal() {
#if defined(__EMSCRIPTEN__)
  return false;
#else
  return isatty(2) != 0;
#endif
}

/// "1", or "1 -> 2" where it changed.
std::string kept_or_changed(const nlohmann::json& pair) {
  const std::string before = pair[0].dump(), after = pair[1].dump();
  return before == after ? before : before + " -> " + after;
}

void print_topology(const nlohmann::json& topology, std::FILE* out) {
  std::fprintf(out, "\n%5s %12s %12s %12s   topology, label surface -> mesh\n", "label", "components",
               "cavities", "handles");
  for (const auto& t : topology["labels"])
    std::fprintf(out, "%5u %12s %12s %12s\n", t["label"].get<unsigned>(),
                 kept_or_changed(t["components"]).c_str(), kept_or_changed(t["cavities"]).c_str(),
                 kept_or_changed(t["handles"]).c_str());
  for (const auto& difference : topology["differences"])
    std::fprintf(out, "      %s\n", difference.get<std::string>().c_str());
  std::fprintf(out,
               "      the label surface is the smoothed extraction: marching tetrahedra join voxels over 14\n"
               "      neighbours, marching cubes (a single label) over 6\n");
}

void print_fidelity(const nlohmann::json& fidelity, std::FILE* out) {
  std::fprintf(out, "\n%5s %9s %9s %11s %7s %8s %9s %9s\n", "label", "voxels", "tets", "volume mm3", "error",
               "Dice", "edge mm", "target");
  for (const auto& f : fidelity["labels"])
    std::fprintf(out, "%5u %9u %9u %11.1f %6.2f%% %8.4f %9.3f %9.3f\n", f["label"].get<unsigned>(),
                 f["voxels"].get<unsigned>(), f["tets"].get<unsigned>(), f["mesh_mm3"].get<double>(),
                 f["volume_error_percent"].get<double>(), f["dice"].get<double>(),
                 f["median_edge_mm"].get<double>(), f["target_edge_mm"].get<double>());
  for (const char* direction : {"mesh_to_surface", "surface_to_mesh"}) {
    const auto& d = fidelity[direction];
    std::fprintf(
        out, "distance %-16s mean %.3f  rms %.3f  p95 %.3f  max %.3f (+ %.3f) mm, samples %.2f mm apart\n",
        direction, d["mean_mm"].get<double>(), d["rms_mm"].get<double>(), d["p95_mm"].get<double>(),
        d["max_mm"].get<double>(), d["uncertainty_mm"].get<double>(), d["spacing_mm"].get<double>());
  }
  print_topology(fidelity["topology"], out);
}

}  // namespace

void print_warning(const std::string& message) {
  std::fprintf(stderr, "warning: %s\n", message.c_str());
}

void print_note(const std::string& message) {
  std::fprintf(stderr, "note: %s\n", message.c_str());
}

RunContext printing_context(double time_limit_s, int threads) {
  RunContext ctx;
  ctx.threads = threads;
  struct Running {
    std::string stage;
    Clock::time_point start;
  };
  const auto running = std::make_shared<Running>();
  const bool terminal = on_terminal();
  ctx.on_progress = [running, terminal](const std::string& stage, double fraction) {
    if (fraction <= 0) {
      if (running->stage == stage) return;  // a stage whose parts each begin at 0 is still one stage
      *running = {stage, Clock::now()};
      if (terminal) std::fprintf(stderr, "%-8s ...", stage.c_str());
    } else if (fraction >= 1 && running->stage == stage) {
      const double seconds = std::chrono::duration<double>(Clock::now() - running->start).count();
      std::fprintf(stderr, "%s%-8s %6.2f s\n", terminal ? "\r" : "", stage.c_str(), seconds);
      running->stage.clear();
    } else if (terminal && running->stage == stage) {
      std::fprintf(stderr, "\r%-8s %3.0f %%", stage.c_str(), 100 * fraction);
    }
  };
  ctx.on_warning = [](const std::string& stage, const std::string& message) {
    print_warning(stage + ": " + message);
  };
  if (time_limit_s > 0) {
    const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                     std::chrono::duration<double>(time_limit_s));
    ctx.on_cancelled = [end] { return Clock::now() > end; };
  }
  return ctx;
}

int fail(const Error& error) {
  std::fprintf(stderr, "voxtet: %s: %s\n", error.stage.c_str(), error.message.c_str());
  for (std::size_t i = 0; i < error.where.points.size() && i < 5; ++i) {
    const Eigen::Vector3d& p = error.where.points[i];
    std::fprintf(stderr, "  at %.3f %.3f %.3f mm\n", p.x(), p.y(), p.z());
  }
  if (error.where.points.size() > 5)
    std::fprintf(stderr, "  and %zu places more\n", error.where.points.size() - 5);
  switch (error.code) {
    case ErrorCode::kUsage: return kExitUsage;
    case ErrorCode::kBadInput: return kExitBadInput;
    case ErrorCode::kMeshing: return kExitMeshing;
    case ErrorCode::kDiffers: return kExitDiffers;
    case ErrorCode::kOutOfMemory:
    case ErrorCode::kCancelled: return kExitLimits;
    case ErrorCode::kInternal: return kExitMeshing;
  }
  return kExitMeshing;
}

void print_quality(const nlohmann::json& quality, std::FILE* out) {
  std::fprintf(out, "\n%-24s %9s %9s %9s %9s %9s\n", "measure", "min", "1 %", "median", "99 %", "max");
  for (const auto& m : quality["metrics"])
    std::fprintf(out, "%-24s %9.3f %9.3f %9.3f %9.3f %9.3f  %s\n", m["name"].get<std::string>().c_str(),
                 m["min"].get<double>(), m["p1"].get<double>(), m["median"].get<double>(),
                 m["p99"].get<double>(), m["max"].get<double>(),
                 m["unit"] == "1" ? "" : m["unit"].get<std::string>().c_str());
  std::fprintf(out, "\n");
  for (const auto& item : quality["checklist"])
    std::fprintf(out, "%s %-28s %s (expected %s)\n",
                 item["passed"].get<bool>() ? "ok  " : (item["hard"].get<bool>() ? "FAIL" : "note"),
                 item["name"].get<std::string>().c_str(), item["found"].get<std::string>().c_str(),
                 item["expected"].get<std::string>().c_str());
}

void print_stages(const nlohmann::json& stages, std::FILE* out) {
  double total = 0;
  for (const auto& s : stages) {
    std::fprintf(out, "%-8s %7.2f s %8.0f MB peak\n", s["name"].get<std::string>().c_str(),
                 s["seconds"].get<double>(), s["peak_mb"].get<double>());
    for (const auto& note : s["notes"]) std::fprintf(out, "%-8s   %s\n", "", note.get<std::string>().c_str());
    total += s["seconds"].get<double>();
  }
  std::fprintf(out, "%-8s %7.2f s\n", "total", total);
}

namespace {

void print_transfer(const nlohmann::json& report, std::FILE* out) {
  if (!report.contains("transfer")) return;
  std::fprintf(out, "\n%5s %11s %-13s %11s %8s %8s\n", "label", "voxels mm3", "transferred", "volume mm3",
               "error", "Dice");
  for (const auto& l : report["transfer"])
    for (const char* rule : {"by_fraction", "by_centroid", "by_majority"}) {
      std::fprintf(out, "%5u %11.1f %-13s %11.1f %7.2f%%", l["label"].get<unsigned>(),
                   l["voxel_mm3"].get<double>(), rule, l[rule]["mm3"].get<double>(),
                   l[rule]["error_percent"].get<double>());
      if (l[rule].contains("dice")) std::fprintf(out, " %8.4f", l[rule]["dice"].get<double>());
      std::fprintf(out, "\n");
    }
}

void print_layers(const nlohmann::json& report, std::FILE* out) {
  if (!report.contains("layers")) return;
  std::fprintf(out, "\nlayers between the surfaces, by area of the outer one\n");
  for (const auto& l : report["layers"]) {
    for (const char* method : {"by_edges", "by_lines"}) {
      std::fprintf(out, "wall %s, %u layers asked for, %s: %.1f %% exact, %.1f %% no fewer\n",
                   l["wall"].dump().c_str(), l["target_layers"].get<unsigned>(), method,
                   100 * l[method]["exact"].get<double>(), 100 * l[method]["at_least"].get<double>());
    }
    for (const auto& place : l["places"]) {
      const auto& centre = place["centre_mm"];
      std::fprintf(out, "  %s layers by edges on %.1f mm2 around (%.1f, %.1f, %.1f)\n",
                   place["layers"].dump().c_str(), place["area_mm2"].get<double>(), centre[0].get<double>(),
                   centre[1].get<double>(), centre[2].get<double>());
    }
  }
}

}  // namespace

void print_forecast(const nlohmann::json& forecast, std::FILE* out) {
  const auto print = [out](const nlohmann::json& f) {
    std::fprintf(
        out,
        "%lld tetrahedra, %lld points, %lld triangles, %.0f MB, %.1f s, here %.1f to %.1f s (forecast)\n",
        f["tets"].get<long long>(), f["points"].get<long long>(), f["triangles"].get<long long>(),
        f["peak_mb"].get<double>(), f["seconds"].get<double>(), f["seconds_here"][0].get<double>(),
        f["seconds_here"][1].get<double>());
  };
  print(forecast);
  if (!forecast.contains("fitting")) return;
  const nlohmann::json& fitting = forecast["fitting"];
  std::fprintf(out, "edge lengths times %.4g, sizing.edge_mm %.4g: ", fitting["factor"].get<double>(),
               fitting["edge_mm"].get<double>());
  print(fitting["forecast"]);
}

void print_report(const nlohmann::json& report, std::FILE* out) {
  std::fprintf(out, "%u tetrahedra, %u points, digest %s\n", report["tets"].get<unsigned>(),
               report["points"].get<unsigned>(), report["digest"].get<std::string>().c_str());
  if (report.contains("fidelity")) print_fidelity(report["fidelity"], out);
  print_transfer(report, out);
  print_layers(report, out);
  print_quality(report["quality"], out);
  std::fprintf(out, "\n");
  print_stages(report["stages"], out);
}

}  // namespace voxtet
