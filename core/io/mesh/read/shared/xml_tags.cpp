#include "io/mesh/read/shared/xml_tags.h"

#include <algorithm>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

bool is_in_xml_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == '.' || c == ':';
}

}  // namespace

std::string_view XmlTag::operator[](std::string_view attribute) const {
  for (const auto& [key, value] : attributes)
    if (key == attribute) return value;
  return {};
}

bool XmlTags::fail(const std::string& message) {
  const auto lines = std::count(file_.begin(), file_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
  error_ = "line " + std::to_string(lines + 1) + ": " + message;
  return false;
}

bool XmlTags::next(XmlTag& tag, std::string_view& text) {
  const std::size_t begin = at_;
  for (;;) {
    at_ = file_.find('<', at_);
    if (at_ == std::string_view::npos) {
      at_ = file_.size();
      return fail("the file ends inside the XML");
    }
    if (begins("<!--")) {
      if (!skip_behind("-->")) return false;
    } else if (begins("<?")) {
      if (!skip_behind("?>")) return false;
    } else {
      break;
    }
  }
  text = file_.substr(begin, at_ - begin);
  return read_tag(tag) && nest(tag);
}

bool XmlTags::nest(const XmlTag& tag) {
  if (tag.closing) {
    if (open_.empty() || open_.back() != tag.name)
      return fail("</" + std::string(tag.name) + "> closes nothing");
    open_.pop_back();
  } else if (open_.empty() && tag.name != root_) {
    return fail("the first tag is " + in_quotes(tag.name) + ", expected " + std::string(root_));
  }
  parent_ = open_.empty() ? std::string_view{} : open_.back();
  if (!tag.closing && !tag.empty) open_.push_back(tag.name);
  return true;
}

bool XmlTags::skip_behind(std::string_view marker) {
  const std::size_t found = file_.find(marker, at_);
  if (found == std::string_view::npos) return fail("no " + std::string(marker) + " follows");
  at_ = found + marker.size();
  return true;
}

void XmlTags::skip_space() {
  while (at_ < file_.size() && is_space(file_[at_])) ++at_;
}

std::string_view XmlTags::read_name() {
  const std::size_t begin = at_;
  while (at_ < file_.size() && is_in_xml_name(file_[at_])) ++at_;
  return file_.substr(begin, at_ - begin);
}

bool XmlTags::read_tag(XmlTag& tag) {
  tag = {};
  ++at_;
  if (begins("/")) {
    tag.closing = true;
    ++at_;
  }
  tag.name = read_name();
  if (tag.name.empty()) return fail("a tag without a name");
  for (;;) {
    skip_space();
    if (begins(">")) {
      ++at_;
      return true;
    }
    if (begins("/>")) {
      tag.empty = true;
      at_ += 2;
      return true;
    }
    const std::string_view key = read_name();
    skip_space();
    if (key.empty() || !begins("=")) return fail("tag " + in_quotes(tag.name) + " is not well formed");
    ++at_;
    skip_space();
    const char quote = at_ < file_.size() ? file_[at_] : '\0';
    const std::size_t stop =
        quote == '"' || quote == '\'' ? file_.find(quote, at_ + 1) : std::string_view::npos;
    if (stop == std::string_view::npos) return fail("attribute " + in_quotes(key) + " is not in quotes");
    tag.attributes.emplace_back(key, file_.substr(at_ + 1, stop - at_ - 1));
    at_ = stop + 1;
  }
}

}  // namespace voxtet
