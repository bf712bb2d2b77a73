#include "io/bytes/byte_source.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <new>

namespace voxtet {
namespace {

constexpr const char* kInflater = "inflate";
constexpr std::size_t kBlock = std::size_t{1} << 20;

class MemorySource : public ByteSource {
 public:
  explicit MemorySource(std::span<const std::uint8_t> bytes) : left_(bytes) {}
  Result<std::size_t> read(std::span<std::uint8_t> out) override {
    const std::size_t count = std::min(out.size(), left_.size());
    if (count > 0) std::memcpy(out.data(), left_.data(), count);
    left_ = left_.subspan(count);
    return count;
  }
  std::uint64_t at_most_left() const override { return left_.size(); }
  bool compressed() const override { return false; }

 private:
  std::span<const std::uint8_t> left_;
};

class InflateSource : public ByteSource {
 public:
  explicit InflateSource(std::span<const std::uint8_t> bytes) : left_(bytes) {
    gzip_ = bytes.size() >= 2 && bytes[0] == 0x1f && bytes[1] == 0x8b;
    if (inflateInit2(&stream_, MAX_WBITS + (gzip_ ? 16 : 0)) != Z_OK) throw std::bad_alloc();
  }
  ~InflateSource() override { inflateEnd(&stream_); }
  InflateSource(const InflateSource&) = delete;
  InflateSource& operator=(const InflateSource&) = delete;

  Result<std::size_t> read(std::span<std::uint8_t> out) override {
    std::size_t done = 0;
    while (done < out.size() && !ended_) {
      const std::size_t want = std::min(out.size() - done, kBlock);
      const std::size_t give = std::min(left_.size(), kBlock);
      stream_.next_out = out.data() + done;
      stream_.avail_out = static_cast<uInt>(want);
      stream_.next_in = const_cast<Bytef*>(left_.data());
      stream_.avail_in = static_cast<uInt>(give);
      const int code = inflate(&stream_, Z_NO_FLUSH);
      left_ = left_.subspan(give - stream_.avail_in);
      done += want - stream_.avail_out;
      if (code == Z_STREAM_END) {
        if (Status next = next_member(); !next) return next.error();
      } else if (code == Z_BUF_ERROR && left_.empty()) {
        return bad_input(kInflater, name() + " data are truncated: they end before their trailer");
      } else if (code == Z_MEM_ERROR) {
        throw std::bad_alloc();
      } else if (code != Z_OK && code != Z_BUF_ERROR) {
        return bad_input(kInflater,
                         name() + " data are damaged: " +
                             (stream_.msg != nullptr ? stream_.msg : "a preset dictionary is asked for"));
      }
    }
    return done;
  }

  std::uint64_t at_most_left() const override {
    // A deflate code of one bit for the length and one for the distance yields at most 258 bytes: 1032 a
    // byte. What zlib holds back in its window is the slack.
    return ended_ ? 0 : static_cast<std::uint64_t>(left_.size()) * 1032 + (1U << MAX_WBITS);
  }
  bool compressed() const override { return true; }
  std::uint64_t padding() const override { return padding_; }

 private:
  std::string name() const { return gzip_ ? "gzip" : "zlib"; }

  Status next_member() {
    if (std::all_of(left_.begin(), left_.end(), [](std::uint8_t byte) { return byte == 0; })) {
      padding_ = left_.size();
      left_ = {};
      ended_ = true;
      return std::monostate{};
    }
    if (!gzip_ || left_.size() < 2 || left_[0] != 0x1f || left_[1] != 0x8b)
      return bad_input(kInflater, std::to_string(left_.size()) + " bytes follow the end of the " + name() +
                                      " data; expected none");
    inflateReset(&stream_);
    return std::monostate{};
  }

  std::span<const std::uint8_t> left_;
  z_stream stream_{};
  bool gzip_ = false;
  bool ended_ = false;
  std::uint64_t padding_ = 0;
};

}  // namespace

Status skip_bytes(ByteSource& source, std::uint64_t count, const std::string& what) {
  std::array<std::uint8_t, 4096> dropped;
  const std::uint64_t asked = count;
  while (count > 0) {
    const std::size_t block = static_cast<std::size_t>(std::min<std::uint64_t>(count, dropped.size()));
    Result<std::size_t> got = source.read({dropped.data(), block});
    if (!got) return got.error();
    if (*got < block)
      return bad_input(kInflater, what + " skips " + std::to_string(asked) +
                                      " bytes, but the data end after " +
                                      std::to_string(asked - count + *got));
    count -= block;
  }
  return std::monostate{};
}

std::unique_ptr<ByteSource> make_memory_source(std::span<const std::uint8_t> bytes) {
  return std::make_unique<MemorySource>(bytes);
}

std::unique_ptr<ByteSource> make_inflate_source(std::span<const std::uint8_t> bytes) {
  return std::make_unique<InflateSource>(bytes);
}

Result<std::vector<std::uint8_t>> gzip_bytes(std::span<const std::uint8_t> bytes) {
  const Error failed{ErrorCode::kOutOfMemory, "deflate", "no memory to compress the volume", {}};
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    return failed;
  gz_header header{};
  header.os = 255;  // "unknown", whatever zlib was built for
  deflateSetHeader(&stream, &header);

  std::vector<std::uint8_t> packed;
  std::array<std::uint8_t, 1 << 16> block;
  int code = Z_OK;
  while (code == Z_OK) {
    if (stream.avail_in == 0 && !bytes.empty()) {
      const std::size_t give = std::min(bytes.size(), kBlock);
      stream.next_in = const_cast<Bytef*>(bytes.data());
      stream.avail_in = static_cast<uInt>(give);
      bytes = bytes.subspan(give);
    }
    stream.next_out = block.data();
    stream.avail_out = static_cast<uInt>(block.size());
    code = deflate(&stream, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
    packed.insert(packed.end(), block.data(), stream.next_out);
  }
  deflateEnd(&stream);
  if (code != Z_STREAM_END) return failed;
  return packed;
}

}  // namespace voxtet
