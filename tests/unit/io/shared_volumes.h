// The real volumes that tests of readers go through.
#pragma once

#include <array>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "io/volume/read_volume.h"
#include "support/data.h"

namespace voxtet::test {

inline constexpr std::array<const char*, 13> kSharedVolumes{"biv_ed_oblique_sax.nii.gz",
                                                            "biv_ed_oblique_sax.mha",
                                                            "biv_ed_oblique_sax.seg.nrrd",
                                                            "biv_ed_scar_1mm.nii.gz",
                                                            "biv_es_oblique_sax.nii.gz",
                                                            "biv_mean_1mm.nii.gz",
                                                            "biv_mean_2mm_float32.nii.gz",
                                                            "ct_heart_1.5mm.nii.gz",
                                                            "ct_aorta_dissection_1.5mm.nii.gz",
                                                            "ct_torso_62labels_3mm.nii.gz",
                                                            "prostate_phantom.nrrd",
                                                            "skull.nrrd",
                                                            "mickey.nrrd"};

inline Bytes file_bytes(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace voxtet::test
