#include "io/volume/read_volume.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <new>
#include <stdexcept>
#include <string_view>

#include "io/bytes/byte_source.h"
#include "io/bytes/files.h"
#include "io/bytes/header_text.h"
#include "io/volume/formats/read_metaimage.h"
#include "io/volume/formats/read_mgh.h"
#include "io/volume/formats/read_nifti.h"
#include "io/volume/formats/read_nrrd.h"
#include "io/volume/voxels/judge_volume.h"

namespace voxtet {
namespace {

constexpr const char* kVolumeReader = "read_volume";

bool starts_with(std::span<const std::uint8_t> bytes, std::string_view text) {
  return bytes.size() >= text.size() && std::equal(text.begin(), text.end(), bytes.begin());
}

bool is_gzipped(const VolumeFile& file) {
  return file.bytes.size() >= 2 && file.bytes[0] == 0x1f && file.bytes[1] == 0x8b;
}

/// The first bytes of a compressed file. A second source reads the volume, so that the look ahead needs no
/// buffer.
Result<Bytes> inflated_start(const VolumeFile& file) {
  Bytes start(kNiftiHeaderBytes);
  const Result<std::size_t> got = make_inflate_source(file.bytes)->read(start);
  if (!got) return got.error();
  start.resize(*got);
  return start;
}

Error unknown_gzip(const std::string& expected) {
  return bad_input(kVolumeReader, "gzip data that hold no " + expected +
                                      " header; expected .nii.gz (NRRD and MetaImage compress their voxels "
                                      "only, not the whole file)");
}

bool looks_like_dicom(const VolumeFile& file) {
  constexpr std::size_t kPreamble = 128;
  return file.bytes.size() > kPreamble && starts_with(file.bytes.subspan(kPreamble), "DICM");
}

std::string start_of(const VolumeFile& file) {
  const auto* text = reinterpret_cast<const char*>(file.bytes.data());
  return in_quotes({text, std::min<std::size_t>(file.bytes.size(), 16)});
}

Result<LabelVolume> read_any(const VolumeFile& file, Reading& reading) {
  if (file.bytes.empty()) return bad_input(kVolumeReader, "the file is empty");
  if (is_gzipped(file)) {
    const Result<Bytes> start = inflated_start(file);
    if (!start) return start.error();
    const std::unique_ptr<ByteSource> source = make_inflate_source(file.bytes);
    if (looks_like_nifti(*start)) return read_nifti(*source, reading);
    if (looks_like_mgh(*start)) return read_mgh(*source, reading);
    return unknown_gzip("NIfTI or MGH");
  }
  if (starts_with(file.bytes, "NRRD")) return read_nrrd(file, reading);
  if (looks_like_nifti(file.bytes.first(std::min(file.bytes.size(), kNiftiHeaderBytes))))
    return read_nifti(*make_memory_source(file.bytes), reading);
  if (looks_like_metaimage(file.bytes)) return read_metaimage(file, reading);
  if (looks_like_mgh(file.bytes)) return read_mgh(*make_memory_source(file.bytes), reading);
  if (looks_like_dicom(file))
    return bad_input(kVolumeReader,
                     "is a DICOM file; expected a volume of labels: open the segmentation (DICOM-SEG) in the "
                     "app or in 3D Slicer and save it as .seg.nrrd, or convert it with dcmqi's "
                     "segimage2itkimage; a series of images with dcm2niix");
  return bad_input(kVolumeReader,
                   "starts with " + start_of(file) +
                       "; expected NIfTI (.nii, .nii.gz), NRRD (.nrrd, .nhdr), MetaImage (.mha, .mhd) or MGH "
                       "(.mgh, .mgz)");
}

Result<ScalarVolume> read_any_scalars(const VolumeFile& file, Reading& reading) {
  if (file.bytes.empty()) return bad_input(kVolumeReader, "the file is empty");
  if (is_gzipped(file)) {
    const Result<Bytes> start = inflated_start(file);
    if (!start) return start.error();
    if (!looks_like_nifti(*start)) return unknown_gzip("NIfTI");
    return read_nifti_scalars(*make_inflate_source(file.bytes), reading);
  }
  if (looks_like_nifti(file.bytes.first(std::min(file.bytes.size(), kNiftiHeaderBytes))))
    return read_nifti_scalars(*make_memory_source(file.bytes), reading);
  return bad_input(kVolumeReader, "starts with " + start_of(file) +
                                      "; expected an image of numbers as NIfTI (.nii, .nii.gz)");
}

/// Puts the name of the file before the message.
template <class Volume>
Result<Volume> named(const std::string& name, Result<Volume> volume) {
  if (volume) return volume;
  Error error = volume.error();
  error.message = name + ": " + error.message;
  return error;
}

template <class Read>
auto guarded(const std::string& name, Read read) -> decltype(read()) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  return Error{
      ErrorCode::kOutOfMemory, kVolumeReader, name + ": there is not enough memory for its voxels", {}};
}

}  // namespace

Result<LabelVolume> read_volume(const VolumeFile& file, const ReadOptions& options, ReadRemarks* remarks) {
  return guarded(file.name, [&] {
    Reading reading{options};
    Result<LabelVolume> volume = named(file.name, read_any(file, reading));
    if (volume && remarks) {
      warn_of_unlikely(*volume, reading);
      for (const std::string& warning : reading.remarks.warnings)
        remarks->warnings.push_back(file.name + ": " + warning);
      for (const std::string& note : reading.remarks.notes) remarks->notes.push_back(file.name + ": " + note);
    }
    return volume;
  });
}

Result<ScalarVolume> read_scalar_volume(const VolumeFile& file, ReadRemarks* remarks) {
  return guarded(file.name, [&] {
    const ReadOptions options;
    Reading reading{options};
    Result<ScalarVolume> volume = named(file.name, read_any_scalars(file, reading));
    if (volume && remarks)
      for (const std::string& warning : reading.remarks.warnings)
        remarks->warnings.push_back(file.name + ": " + warning);
    return volume;
  });
}

Result<LabelVolume> read_volume_file(const std::string& path, const ReadOptions& options,
                                     ReadRemarks* remarks) {
  return guarded(path, [&]() -> Result<LabelVolume> {
    const std::filesystem::path place(path);
    const Result<Bytes> bytes = read_file(path);
    if (!bytes) return bytes.error();
    return read_volume(
        {path, *bytes,
         [&](const std::string& name) { return read_file((place.parent_path() / name).string()); }},
        options, remarks);
  });
}

}  // namespace voxtet
