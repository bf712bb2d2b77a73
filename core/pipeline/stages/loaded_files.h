// The files that a case names, as they were read: the volume, and masks and images of edge lengths.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "types/label_volume.h"
#include "types/read_options.h"
#include "types/scalar_volume.h"

namespace voxtet {

/// A volume other than the one that is meshed, with its digest.
template <class Volume>
struct SideVolume {
  Volume volume;
  std::string digest;
  ReadRemarks remarks;
};

struct LoadedFiles {
  std::shared_ptr<const LabelVolume> volume;               ///< null: none was loaded
  std::string digest;                                      ///< digest_of(*volume)
  ReadOptions options;                                     ///< by which it was read
  ReadRemarks remarks;                                     ///< of its reader
  std::map<std::string, SideVolume<LabelVolume>> masks;    ///< by the file's name
  std::map<std::string, SideVolume<ScalarVolume>> images;  ///< by the file's name
};

}  // namespace voxtet
