#include "io/mesh/write_igb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/igb_header.h"

namespace voxtet {
namespace {

static_assert(std::endian::native == std::endian::little, "the frames are copied as they are in memory");

/// Readers want lines of at most 80 characters, and a form feed as the last byte of the header.
constexpr std::size_t kLine = 72;

}  // namespace

IgbWriter::IgbWriter(std::size_t points, std::string unit, double first_ms, double interval_ms,
                     float elsewhere)
    : points_(points),
      unit_(std::move(unit)),
      first_ms_(first_ms),
      interval_ms_(interval_ms),
      elsewhere_(elsewhere),
      bytes_(IgbHeader::kBytes, ' ') {}

void IgbWriter::add(const std::vector<float>& values) {
  const std::size_t at = bytes_.size();
  bytes_.resize(at + values.size() * sizeof(float));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float value = std::isnan(values[i]) ? elsewhere_ : values[i];
    std::memcpy(&bytes_[at + i * sizeof(float)], &value, sizeof(float));
  }
  ++frames_;
}

Bytes IgbWriter::take() {
  ByteWriter header(IgbHeader::kBytes);
  header.text("x:");
  header.integer(static_cast<std::int64_t>(points_));
  header.text(" y:1 z:1 t:");
  header.integer(static_cast<std::int64_t>(frames_));
  header.text(" type:float systeme:little_endian\r\norg_t:");
  header.real(first_ms_);
  header.text(" inc_t:");
  header.real(interval_ms_);
  header.text(" dim_t:");
  header.real(interval_ms_ * static_cast<double>(frames_ - 1));
  header.text(" unites_t:ms\r\nunites:" + unit_ + " facteur:1 zero:0\r\n");
  const Bytes words = header.take();
  std::copy(words.begin(), words.end(), bytes_.begin());
  for (std::size_t end = words.size() + kLine; end < IgbHeader::kBytes - 2; end += kLine)
    bytes_[end - 2] = '\r', bytes_[end - 1] = '\n';
  bytes_[IgbHeader::kBytes - 1] = '\f';
  return std::move(bytes_);
}

}  // namespace voxtet
