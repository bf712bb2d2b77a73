// libFuzzer entry: any bytes are a volume or an error. Build it with -fsanitize=fuzzer,address against
// voxtet_io; the unit tests drive the same entry with seeded mutations.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "io/volume/read_volume.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> bytes(data, size);
  const auto sibling = [&](const std::string&) -> voxtet::Result<voxtet::Bytes> {
    return voxtet::Bytes(data, data + size);
  };
  const voxtet::Result<voxtet::LabelVolume> volume = voxtet::read_volume({"fuzz", bytes, sibling});
  if (volume.ok() ? volume->labels.size() != volume->voxel_count() : volume.error().message.empty())
    std::abort();
  return 0;
}
