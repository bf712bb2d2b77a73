// dump_volume: how voxtet reads volumes, for scripts that compare it with other readers.
// Sample run: printf '%s\n' a.nii.gz b.mha | dump_volume out
// Writes, for line n of the input, out/n.u16 (labels, little-endian) and one line of JSON to standard output:
// {"size": [...], "affine": [16 numbers, row by row]} or {"error": "..."}. With a second argument `nifti` it
// also writes the volume again as out/n.nii.gz.
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include "io/volume/read_volume.h"
#include "io/volume/write_volume.h"

namespace {

void write(const std::string& path, const void* data, std::size_t size) {
  std::ofstream(path, std::ios::binary)
      .write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
}

std::string json_string(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c < ' ' ? ' ' : c;
  }
  return quoted + '"';
}

void dump(const voxtet::LabelVolume& volume, const std::string& base, bool nifti) {
  write(base + ".u16", volume.labels.data(), volume.labels.size() * sizeof(voxtet::Label));
  if (nifti) {
    const voxtet::Result<voxtet::Bytes> bytes = voxtet::write_nifti(volume, true);
    if (bytes.ok()) write(base + ".nii.gz", bytes->data(), bytes->size());
  }
  std::printf("{\"size\": [%d, %d, %d], \"affine\": [", volume.size[0], volume.size[1], volume.size[2]);
  for (int n = 0; n < 16; ++n) std::printf("%s%.17g", n > 0 ? ", " : "", volume.index_to_mm(n / 4, n % 4));
  std::printf("]}\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  std::string path;
  for (int n = 0; std::getline(std::cin, path); ++n) {
    const voxtet::Result<voxtet::LabelVolume> volume = voxtet::read_volume_file(path);
    if (volume.ok())
      dump(*volume, std::string(argv[1]) + "/" + std::to_string(n), argc > 2);
    else
      std::printf("{\"error\": %s}\n", json_string(volume.error().message).c_str());
  }
  return 0;
}
