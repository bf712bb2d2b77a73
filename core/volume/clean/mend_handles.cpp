#include "volume/clean/mend_handles.h"

#include <algorithm>
#include <array>
#include <vector>

#include "geometry/topology/uniform_block.h"
#include "volume/clean/face_areas.h"
#include "volume/clean/padded_labels.h"
#include "volume/clean/relabel_trial.h"

namespace voxtet {
namespace {

using Voxels = std::vector<std::size_t>;

class HandleMender {
 public:
  HandleMender(const LabelVolume& volume, std::uint32_t limit_voxels, Connectivity connectivity)
      : labels_(volume),
        areas_(face_areas(volume)),
        limit_(limit_voxels),
        trial_(labels_, connectivity),
        faces_{labels_.step({-1, 0, 0}), labels_.step({1, 0, 0}),  labels_.step({0, -1, 0}),
               labels_.step({0, 1, 0}),  labels_.step({0, 0, -1}), labels_.step({0, 0, 1})} {}

  void run() {
    // What one change mends may let another one be seen; each takes a handle, so that this ends.
    while (mend(thin_parts()) || mend(single_voxels())) continue;
    fill_pits();
  }

  const PaddedLabels& labels() const { return labels_; }
  const std::map<Label, MendedLabel>& mended() const { return mended_; }

 private:
  Label at(std::size_t voxel) const { return labels_.labels[voxel]; }
  static std::size_t after(std::size_t voxel, std::ptrdiff_t step) {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(voxel) + step);
  }

  /// The thin parts with few enough voxels, the smallest first.
  std::vector<Voxels> thin_parts() const {
    std::vector<bool> thin(labels_.labels.size(), false);
    labels_.for_inner(
        [&](std::size_t voxel) { thin[voxel] = !in_uniform_block(labels_.size, labels_.labels, voxel); });
    std::vector<Voxels> parts;
    labels_.for_inner([&](std::size_t voxel) {
      if (!thin[voxel]) return;
      Voxels part{voxel};
      thin[voxel] = false;
      for (std::size_t n = 0; n < part.size(); ++n)
        for (const std::ptrdiff_t step : trial_.steps_of(at(voxel)))
          if (const std::size_t other = after(part[n], step); thin[other] && at(other) == at(voxel)) {
            thin[other] = false;
            part.push_back(other);
          }
      if (part.size() >= limit_) return;
      std::sort(part.begin(), part.end());
      parts.push_back(std::move(part));
    });
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Voxels& a, const Voxels& b) { return a.size() < b.size(); });
    return parts;
  }

  /// Those where labels meet.
  std::vector<Voxels> single_voxels() const {
    std::vector<Voxels> voxels;
    labels_.for_inner([&](std::size_t voxel) {
      if (std::any_of(faces_.begin(), faces_.end(),
                      [&](std::ptrdiff_t step) { return at(after(voxel, step)) != at(voxel); }))
        voxels.push_back({voxel});
    });
    return voxels;
  }

  /// Whether any of these parts was given another label, and took handles with it.
  bool mend(const std::vector<Voxels>& parts) {
    bool any = false;
    for (const Voxels& part : parts) {
      const Label from = at(part.front());
      // What was mended before may have changed some of them.
      if (std::any_of(part.begin(), part.end(), [&](std::size_t voxel) { return at(voxel) != from; }))
        continue;
      const Label to = neighbour_by_area(labels_.size, labels_.labels, part, areas_);
      if (to == from) continue;
      const HandlesTaken taken = trial_.handles_taken(part, to);
      if (!taken.any()) continue;
      any = true;
      for (const std::size_t voxel : part) labels_.labels[voxel] = to;
      if (taken.opened > 0) {
        mended_[from].opened += static_cast<std::size_t>(taken.opened);
        mended_[from].opened_voxels += part.size();
      }
      if (taken.closed > 0) {
        mended_[to].closed += static_cast<std::size_t>(taken.closed);
        mended_[to].closed_voxels += part.size();
      }
    }
    return any;
  }

  /// The label on at least so many sides of a voxel; background where none is.
  Label around(std::size_t voxel, int sides) const {
    for (const std::ptrdiff_t step : faces_) {
      const Label label = at(after(voxel, step));
      if (label != kBackground && std::count_if(faces_.begin(), faces_.end(), [&](std::ptrdiff_t other) {
                                    return at(after(voxel, other)) == label;
                                  }) >= sides)
        return label;
    }
    return kBackground;
  }

  /// From its bottom to its mouth; what has been filled before is not in it.
  Voxels pit_from(std::size_t bottom, Label wall) const {
    Voxels pit{bottom};
    for (std::size_t last = bottom; pit.size() < limit_; last = pit.back()) {
      const auto open = std::find_if(faces_.begin(), faces_.end(), [&](std::ptrdiff_t step) {
        const std::size_t next = after(last, step);
        return at(next) == kBackground && around(next, 4) == wall &&
               (pit.size() < 2 || next != pit[pit.size() - 2]);
      });
      if (open == faces_.end()) return pit;
      pit.push_back(after(last, *open));
    }
    return pit;
  }

  void fill_pits() {
    labels_.for_inner([&](std::size_t bottom) {
      if (at(bottom) != kBackground) return;
      const Label wall = around(bottom, 5);
      if (wall == kBackground) return;
      const Voxels pit = pit_from(bottom, wall);
      if (pit.size() < 2 || pit.size() >= limit_) return;
      std::size_t filled = 0;
      for (const std::size_t voxel : pit) {
        if (!trial_.is_simple(voxel, wall)) break;
        labels_.labels[voxel] = wall;
        ++filled;
      }
      if (filled == 0) return;
      ++mended_[wall].pits;
      mended_[wall].pit_voxels += filled;
    });
  }

  PaddedLabels labels_;
  const std::array<double, 3> areas_;
  const std::uint32_t limit_;
  RelabelTrial trial_;
  const std::array<std::ptrdiff_t, 6> faces_;
  std::map<Label, MendedLabel> mended_;
};

}  // namespace

std::map<Label, MendedLabel> mend_handles(LabelVolume& volume, std::uint32_t limit_voxels,
                                          Connectivity connectivity) {
  if (limit_voxels == 0) return {};
  HandleMender mender(volume, limit_voxels, connectivity);
  mender.run();
  mender.labels().write_to(volume);
  return mender.mended();
}

}  // namespace voxtet
