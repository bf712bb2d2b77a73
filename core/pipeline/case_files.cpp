#include "pipeline/case_files.h"

#include <filesystem>
#include <string_view>

#include "io/bytes/files.h"

namespace voxtet {

namespace fs = std::filesystem;

Result<Recipe> read_case_file(const std::string& path) {
  const Result<Bytes> bytes = read_file(path);
  if (!bytes) return bytes.error();
  Result<Recipe> recipe =
      parse_recipe(std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
  if (recipe) return recipe;
  Error error = recipe.error();
  error.message = path + ": " + error.message;
  return error;
}

Result<Bytes> read_case_bytes(const std::string& path) {
  std::error_code failed;
  const fs::file_status found = fs::status(path, failed);
  if (fs::exists(found) && !fs::is_regular_file(found))
    return Error{
        ErrorCode::kBadInput, "files", path + ": found a folder, pipe or device, expected a file", {}};
  return read_file(path);
}

VolumeFile file_at(const std::string& path, std::span<const std::uint8_t> bytes) {
  return {fs::path(path).filename().string(), bytes,
          [folder = fs::path(path).parent_path()](const std::string& name) {
            return read_file((folder / name).string());
          }};
}

SidePaths side_paths(const Recipe& recipe, const std::string& folder) {
  SidePaths paths;
  for (const MaskSize& mask : recipe.sizing.masks)
    paths.masks.push_back((fs::path(folder) / mask.name).string());
  for (const ImageSize& image : recipe.sizing.images)
    paths.images.push_back((fs::path(folder) / image.name).string());
  return paths;
}

Status open_case_file(const std::string& path, const LoadFile& load) {
  const Result<Bytes> bytes = read_case_bytes(path);
  if (!bytes) return bytes.error();
  return load(file_at(path, *bytes));
}

Status load_side_files(const SidePaths& paths, Session& session, const OpenFile& open) {
  for (const std::string& path : paths.masks)
    if (Status loaded = open(path, [&](const VolumeFile& file) { return session.load_mask(file); }); !loaded)
      return loaded;
  for (const std::string& path : paths.images)
    if (Status loaded = open(path, [&](const VolumeFile& file) { return session.load_size_image(file); });
        !loaded)
      return loaded;
  return std::monostate{};
}

}  // namespace voxtet
