#include "volume/cut_labels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "geometry/topology/label_components.h"
#include "types/stage_names.h"
#include "volume/extend_cuts.h"
#include "volume/select_labels.h"

namespace voxtet {
namespace {

constexpr double kOnPlane = 1e-9;  ///< of a voxel
constexpr std::size_t kSidesOfImage = 6;

/// Along the normal, mm for each step of one voxel.
double step_mm(const Grid& grid, const CutPlane& plane) {
  return (grid.linear().transpose() * plane.normal).norm();
}

/// Calls visit(voxel, plane, distance) for each voxel of a label that is cut, with the distance beyond the
/// first plane that cuts the label there, in voxels.
template <class Visit>
void visit_cut(const LabelVolume& labels, const CutPlanes& planes, Visit&& visit) {
  std::vector<Eigen::Vector4d> distance_of;  // of an index
  for (const CutPlane& plane : planes) {
    const double step = step_mm(labels, plane);
    Eigen::Vector4d row;
    row << labels.linear().transpose() * plane.normal, plane.distance_mm(labels.origin());
    distance_of.push_back(row / step);
  }
  labels.visit([&](int i, int j, int k, std::size_t at) {
    if (labels.labels[at] == kBackground) return;
    const Eigen::Vector4d index(i, j, k, 1);
    for (std::size_t c = 0; c < planes.size(); ++c)
      if (const double distance = distance_of[c].dot(index);
          distance > kOnPlane && planes[c].cuts(labels.labels[at])) {
        visit(at, c, distance);
        return;
      }
  });
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string in_words(const Eigen::Vector3d& v) {
  return number(v[0]) + ", " + number(v[1]) + ", " + number(v[2]);
}

std::string label_text(const LabelVolume& volume, Label label) {
  for (const LabelInfo& info : volume.infos)
    if (info.label == label && !info.name.empty()) return std::to_string(label) + " (" + info.name + ")";
  return std::to_string(label);
}

std::string field_of(std::size_t c) {
  return "volume.cut[" + std::to_string(c) + "]";
}

bool is_word(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

/// From how far before the plane to how far beyond it the labels reach, in words.
std::string reach_in_words(const LabelVolume& labels, const CutPlane& plane) {
  double low = 0, high = 0;
  bool any = false;
  labels.visit([&](int i, int j, int k, std::size_t at) {
    if (!plane.cuts(labels.labels[at])) return;
    const double distance = plane.distance_mm(labels.to_mm(i, j, k));
    low = any ? std::min(low, distance) : distance;
    high = any ? std::max(high, distance) : distance;
    any = true;
  });
  return "they lie from " + number(low) + " to " + number(high) + " mm along the normal from its point";
}

/// The share of a box on the near side of a plane: its half extents along the normal, and how far its middle
/// is beyond. The distribution of the sum of three even ones.
double share_before(Eigen::Vector3d half, double beyond) {
  constexpr double kFlat = 1e-3;
  half = half.cwiseAbs();
  half = half.cwiseMax(kFlat * half.maxCoeff());
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double reach = half.sum() - beyond;
    for (int d = 0; d < 3; ++d)
      if ((corner >> d & 1) != 0) reach -= 2 * half[d];
    const int sign = (corner & 1) + (corner >> 1 & 1) + (corner >> 2 & 1);
    if (reach > 0) sum += (sign % 2 == 0 ? 1 : -1) * reach * reach * reach;
  }
  return std::clamp(sum / (48 * half.prod()), 0.0, 1.0);
}

/// Pieces beyond a plane that nowhere reach a voxel beyond it become what is around them: the surface has no
/// such piece once it is smooth, or a flat one.
void drop_shallow(LabelVolume& labels, const CutPlanes& planes, const std::vector<float>& depth) {
  constexpr float kShallow = 1;
  std::vector<std::uint32_t> sizes;
  const std::vector<std::uint32_t> piece =
      label_components(labels.size, labels.labels, sizes, Connectivity::kKuhn);
  std::vector<float> deepest(sizes.size(), 0);
  for (std::size_t v = 0; v < piece.size(); ++v) deepest[piece[v]] = std::max(deepest[piece[v]], depth[v]);
  std::map<std::uint32_t, std::map<Label, std::size_t>> around;
  for (std::size_t v = 0; v < piece.size(); ++v) {
    if (depth[v] == 0 || deepest[piece[v]] >= kShallow) continue;
    std::map<Label, std::size_t>& faces = around[piece[v]];
    const auto plane = std::find_if(planes.begin(), planes.end(),
                                    [&](const CutPlane& cut) { return cut.beyond == labels.labels[v]; });
    for_face_neighbours(labels.size, v, [&](std::size_t other, std::size_t) {
      const Label label = labels.labels[other];
      if (!is_beyond(planes, label) && !plane->cuts(label)) ++faces[label];
    });
  }
  for (std::size_t v = 0; v < piece.size(); ++v) {
    const auto found = around.find(piece[v]);
    if (found == around.end()) continue;
    const auto most = std::max_element(found->second.begin(), found->second.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    labels.labels[v] = most == found->second.end() ? kBackground : most->first;
  }
}

}  // namespace

Result<CutPlanes> planes_given(const std::vector<CutParams>& params, const LabelVolume& labels) {
  if (params.size() > kMostCuts - kSidesOfImage)
    return usage_error(kVolumeStage, "volume.cut: found " + std::to_string(params.size()) +
                                         " planes, expected at most " +
                                         std::to_string(kMostCuts - kSidesOfImage));
  std::vector<Label> present;
  if (!params.empty())
    for (const auto& [label, count] : count_labels(labels)) present.push_back(label);
  std::set<std::string> names;
  for (const CutParams& cut : params)
    if (!cut.name.empty() && !names.insert(cut.name).second)
      return usage_error(kVolumeStage, "volume.cut: found the name " + cut.name +
                                           " of two planes, expected names that differ");
  CutPlanes planes;
  for (std::size_t c = 0; c < params.size(); ++c) {
    const CutParams& cut = params[c];
    if (!cut.name.empty() && !is_word(cut.name))
      return usage_error(kVolumeStage, field_of(c) + ".name: found '" + cut.name +
                                           "', expected a word of letters, digits, _ and -");
    if (!(cut.normal.norm() > 0) || !cut.normal.allFinite() || !cut.point_mm.allFinite())
      return usage_error(kVolumeStage, field_of(c) + ".normal: found " + in_words(cut.normal) +
                                           ", expected a direction, as 0, 0, 1");
    CutPlane plane;
    plane.normal = cut.normal.normalized();
    plane.offset_mm = plane.normal.dot(cut.point_mm);
    plane.labels = cut.labels.empty() ? present : cut.labels;
    for (const Label label : plane.labels)
      if (std::find(present.begin(), present.end(), label) == present.end()) {
        std::string those;
        for (const Label other : present) those += (those.empty() ? "" : ", ") + label_text(labels, other);
        return usage_error(kVolumeStage, field_of(c) + ".labels: found " + std::to_string(label) +
                                             ", expected labels that are meshed: " + those);
      }
    plane.reach_mm = kBeyondCut * step_mm(labels, plane);
    plane.name = cut.name;
    for (int next = 1; plane.name.empty(); ++next) {
      const std::string name = next == 1 ? "cut" : "cut_" + std::to_string(next);
      if (names.insert(name).second) plane.name = name;
    }
    planes.push_back(std::move(plane));
  }
  return planes;
}

LabelVolume without_cut(const LabelVolume& labels, const CutPlanes& planes) {
  LabelVolume out = labels;
  visit_cut(labels, planes, [&](std::size_t at, std::size_t, double) { out.labels[at] = kBackground; });
  return out;
}

LabelVolume with_beyond(const LabelVolume& labels, const CutPlanes& planes) {
  LabelVolume out = labels;
  std::vector<float> depth(labels.labels.size(), 0);
  visit_cut(labels, planes, [&](std::size_t at, std::size_t c, double distance) {
    const bool far = distance > kBeyondCut;
    out.labels[at] = far ? kBackground : planes[c].beyond;
    depth[at] = far ? 0 : static_cast<float>(distance);
  });
  drop_shallow(out, planes, depth);
  return out;
}

Result<std::vector<CutRecord>> count_cut(const LabelVolume& labels, const CutPlanes& planes,
                                         const RunContext& ctx) {
  std::vector<CutRecord> records;
  for (const CutPlane& plane : planes) records.push_back({plane.name, {}});
  visit_cut(labels, planes,
            [&](std::size_t at, std::size_t c, double) { ++records[c].voxels[labels.labels[at]]; });
  std::map<Label, std::size_t> left;
  for (const auto& [label, count] : count_labels(labels)) left[label] = count;
  for (std::size_t c = 0; c < planes.size(); ++c) {
    const std::string plane = field_of(c) + ", the plane " + planes[c].name;
    if (records[c].voxels.empty()) {
      std::string those;
      for (const Label label : planes[c].labels)
        those += (those.empty() ? "" : ", ") + label_text(labels, label);
      ctx.warn(kVolumeStage, plane + ", cuts nothing of the labels " + those + ": " +
                                 reach_in_words(labels, planes[c]) +
                                 "; expected some of them on the side that its normal points to");
    }
    std::string taken;
    for (const auto& [label, count] : records[c].voxels) {
      taken += (taken.empty() ? "" : ", ") + std::to_string(count) + " voxels of label " +
               label_text(labels, label);
      left[label] -= count;
      if (left[label] > 0) continue;
      const std::string gone = plane + ", cuts away all of label " + label_text(labels, label);
      const bool any = std::any_of(left.begin(), left.end(), [](const auto& of) { return of.second > 0; });
      if (!any)
        return usage_error(kVolumeStage,
                           gone + ": " + reach_in_words(labels, planes[c]) +
                               "; expected some of it on the other side: turn the normal round?");
      ctx.warn(kVolumeStage, gone + ": it is not in the mesh");
    }
    if (!taken.empty()) ctx.note(kVolumeStage, "the plane " + planes[c].name + " cuts away " + taken);
  }
  return records;
}

std::map<Label, double> divided_mm3(const LabelVolume& labels, const CutPlanes& planes) {
  std::map<Label, double> more;
  const double voxel_mm3 = labels.voxel_mm3();
  for (std::size_t c = 0; c < planes.size(); ++c) {
    const CutPlane& plane = planes[c];
    const Eigen::Vector3d half = 0.5 * (labels.linear().transpose() * plane.normal);
    labels.visit([&](int i, int j, int k, std::size_t at) {
      const Label label = labels.labels[at];
      if (!plane.cuts(label)) return;
      const Eigen::Vector3d middle = labels.to_mm(i, j, k);
      const double beyond = plane.distance_mm(middle);
      if (std::abs(beyond) >= half.cwiseAbs().sum()) return;
      for (std::size_t other = 0; other < planes.size(); ++other)
        if (other != c && planes[other].cuts(label) && planes[other].distance_mm(middle) > 0) return;
      const double counted = beyond > kOnPlane * step_mm(labels, plane) ? 0 : 1;
      more[label] += (share_before(half, beyond) - counted) * voxel_mm3;
    });
  }
  return more;
}

}  // namespace voxtet
