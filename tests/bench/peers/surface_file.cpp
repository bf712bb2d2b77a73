#include "bench/peers/surface_file.h"

#include <cstdint>
#include <fstream>
#include <vector>

namespace voxtet::peers {
namespace {

template <class T>
void put(std::ofstream& file, const T* values, std::size_t count) {
  file.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
}

template <class T>
void put(std::ofstream& file, const std::vector<T>& values) {
  const std::uint64_t count = values.size();
  put(file, &count, 1);
  put(file, values.data(), values.size());
}

template <class T>
void get(std::ifstream& file, T* values, std::size_t count) {
  file.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
}

template <class T>
void get(std::ifstream& file, std::vector<T>& values) {
  std::uint64_t count = 0;
  get(file, &count, 1);
  if (!file) return;
  values.resize(count);
  get(file, values.data(), values.size());
}

Error file_error(const std::string& path, const std::string& found) {
  return {ErrorCode::kBadInput, "peers", path + ": " + found, {}};
}

}  // namespace

Status write_fill_task(const FillTask& task, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  put(file, task.surface.points);
  put(file, task.surface.triangles);
  put(file, task.surface.sides);
  put(file, task.sizing.size.data(), 3);
  put(file, task.sizing.index_to_mm.data(), 16);
  put(file, task.sizing.mm_to_index.data(), 16);
  put(file, task.sizing.h_mm);
  file.close();
  if (!file) return file_error(path, "cannot be written");
  return std::monostate{};
}

Result<FillTask> read_fill_task(const std::string& path) {
  FillTask task;
  std::ifstream file(path, std::ios::binary);
  get(file, task.surface.points);
  get(file, task.surface.triangles);
  get(file, task.surface.sides);
  get(file, task.sizing.size.data(), 3);
  get(file, task.sizing.index_to_mm.data(), 16);
  get(file, task.sizing.mm_to_index.data(), 16);
  get(file, task.sizing.h_mm);
  if (!file)
    return file_error(path, "found no whole surface and sizing field, expected what peer_voxtet wrote");
  return task;
}

}  // namespace voxtet::peers
