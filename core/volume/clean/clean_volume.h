// What noise a segmentation holds, and its removal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

/// Sizes in voxels; 0 leaves everything.
struct CleanLimits {
  std::uint32_t speck_voxels = 0;   ///< smaller components of a label are removed, apart from its largest
  std::uint32_t hole_voxels = 0;    ///< smaller enclosed components of background are filled
  std::uint32_t handle_voxels = 0;  ///< smaller handles, tunnels and pits one voxel wide are mended

  bool none() const { return speck_voxels == 0 && hole_voxels == 0 && handle_voxels == 0; }
};

/// The limits of cleaning that is asked for without numbers: what has fewer voxels than a cube of three. Such
/// a cube is the least body with a voxel inside; elements of the usual size, two voxels, cannot show less.
inline constexpr CleanLimits kUsualCleaning{27, 27, 27};

enum class FlawKind { kPieces, kHoles, kHandles, kTunnels, kPits };

/// All flaws of one kind.
struct Flaw {
  FlawKind kind;
  std::size_t count = 0;
  std::size_t voxels = 0;   ///< of all of them, or changed to mend them
  std::size_t largest = 0;  ///< voxels of the largest piece or hole; 0 for the other kinds
  std::vector<std::pair<Label, std::size_t>> labels = {};  ///< whose they are, and how many; none for holes
};
using Flaws = std::vector<Flaw>;

/// "pieces", "holes", "handles", "tunnels", "pits"
const char* name_of(FlawKind kind);

/// "3,012 loose pieces of labels 1 (1,010), 2 (2,002): 3,400 voxels, the largest of 5"
std::string in_words(const Flaw& flaw);

/// Removes components and holes (remove_specks.h), then mends handles, tunnels and pits (mend_handles.h).
/// Returns what was done, by kind.
Flaws clean_volume(LabelVolume& volume, const CleanLimits& limits);

/// What usual cleaning would mend.
Flaws find_flaws(LabelVolume volume);

}  // namespace voxtet
