// The files that a case names, as they were read: the volume or mesh, and masks and images of edge lengths.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/sources/opened_mesh.h"
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
  std::shared_ptr<const LabelVolume> volume;  ///< null: none was loaded
  /// Null: an image was loaded. Else no stage makes a mesh, and `volume` is voxels_of() this one.
  std::shared_ptr<const OpenedMesh> mesh;
  std::string digest;                                      ///< of the mesh, else of the volume
  ReadOptions options;                                     ///< by which it was read
  ReadRemarks remarks;                                     ///< of its reader
  std::map<std::string, SideVolume<LabelVolume>> masks;    ///< by the file's name
  std::map<std::string, SideVolume<ScalarVolume>> images;  ///< by the file's name
};

}  // namespace voxtet
