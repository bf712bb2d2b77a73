#include "recipe/link.h"

#include <zlib.h>

#include <array>
#include <nlohmann/json.hpp>

#include "base/base64url.h"

namespace voxtet {
namespace {

constexpr std::string_view kCompressed = "#c1=";
constexpr std::string_view kPlain = "#j=";
constexpr std::size_t kMaxInflated = 1 << 20;

std::string deflate_raw(const std::string& text) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

Result<std::string> inflate_raw(const std::string& bytes) {
  z_stream stream{};
  inflateInit2(&stream, -MAX_WBITS);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string out;
  std::array<char, 16384> chunk{};
  int code = Z_OK;
  while (code == Z_OK && out.size() <= kMaxInflated) {
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = static_cast<uInt>(chunk.size());
    code = inflate(&stream, Z_NO_FLUSH);
    out.append(chunk.data(), chunk.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (out.size() > kMaxInflated) return usage_error("link", "the link inflates to more than 1 MiB");
  if (code != Z_STREAM_END)
    return usage_error("link", "the link is cut short or damaged: its compressed part does not end");
  return out;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

Result<std::string> percent_decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    if (i + 2 >= text.size() || hex_value(text[i + 1]) < 0 || hex_value(text[i + 2]) < 0)
      return usage_error("link", "the link holds '%' without two hexadecimal digits after it");
    out += static_cast<char>(hex_value(text[i + 1]) * 16 + hex_value(text[i + 2]));
    i += 2;
  }
  return out;
}

}  // namespace

std::string link_fragment(const Recipe& recipe) {
  return std::string(kCompressed) + base64url(deflate_raw(recipe_to_json(recipe, true).dump()));
}

bool is_link(std::string_view text) {
  return text.find(kCompressed) != std::string_view::npos || text.find(kPlain) != std::string_view::npos;
}

Result<Recipe> recipe_of_link(std::string_view text) {
  if (const std::size_t at = text.find(kCompressed); at != std::string_view::npos) {
    Result<std::string> bytes = from_base64url(text.substr(at + kCompressed.size()), "link", "the link");
    if (!bytes) return bytes.error();
    Result<std::string> json = inflate_raw(*bytes);
    if (!json) return json.error();
    return parse_recipe(std::string_view(*json));
  }
  if (const std::size_t at = text.find(kPlain); at != std::string_view::npos) {
    Result<std::string> json = percent_decoded(text.substr(at + kPlain.size()));
    if (!json) return json.error();
    return parse_recipe(std::string_view(*json));
  }
  return usage_error("link", "no case in this link: expected '#c1=' or '#j='");
}

}  // namespace voxtet
