#include "volume/stack/slice_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/grid/distance_transform.h"

namespace voxtet::slices {
namespace {

/// The axes of a slice: the other two, in their order.
std::array<std::size_t, 2> slice_axes(int axis) {
  if (axis == 0) return {1, 2};
  if (axis == 1) return {0, 2};
  return {0, 1};
}

/// Calls visit(offset in the volume) for every voxel in the order of the stack's pixels.
template <class Visit>
void in_slice_order(const std::array<int, 3>& size, int axis, Visit visit) {
  const std::array<std::size_t, 3> length{static_cast<std::size_t>(size[0]),
                                          static_cast<std::size_t>(size[1]),
                                          static_cast<std::size_t>(size[2])};
  const std::array<std::size_t, 3> stride{1, length[0], length[0] * length[1]};
  const auto [u, v] = slice_axes(axis);
  const std::size_t w = static_cast<std::size_t>(axis);
  for (std::size_t k = 0; k < length[w]; ++k)
    for (std::size_t j = 0; j < length[v]; ++j)
      for (std::size_t i = 0; i < length[u]; ++i) visit(i * stride[u] + j * stride[v] + k * stride[w]);
}

struct Box {
  int x0 = 1 << 30, y0 = 1 << 30, x1 = -1, y1 = -1;
};

LabelDistance label_distance(const SliceStack& stack, const Label* slice, Label label, Box box,
                             double far_mm) {
  const int mx = static_cast<int>(std::min(far_mm / stack.pixel_mm[0], 1e6)) + 2;
  const int my = static_cast<int>(std::min(far_mm / stack.pixel_mm[1], 1e6)) + 2;
  box = {std::max(0, box.x0 - mx), std::max(0, box.y0 - my), std::min(stack.width - 1, box.x1 + mx),
         std::min(stack.height - 1, box.y1 + my)};
  LabelDistance out;
  out.label = label;
  out.low = {box.x0, box.y0};
  out.size = {box.x1 - box.x0 + 1, box.y1 - box.y0 + 1};
  out.far_mm = static_cast<float>(far_mm);
  std::vector<std::uint8_t> inside, outside;
  inside.reserve(static_cast<std::size_t>(out.size[0]) * static_cast<std::size_t>(out.size[1]));
  for (int y = box.y0; y <= box.y1; ++y)
    for (int x = box.x0; x <= box.x1; ++x)
      inside.push_back(slice[static_cast<std::size_t>(x) +
                             static_cast<std::size_t>(stack.width) * static_cast<std::size_t>(y)] == label);
  for (const std::uint8_t in : inside) outside.push_back(!in);
  const std::array<int, 3> size{out.size[0], out.size[1], 1};
  const Eigen::Vector3d spacing(stack.pixel_mm[0], stack.pixel_mm[1], 1);
  out.mm = distance_to_mask_mm(size, spacing, outside);
  const std::vector<float> to_label = distance_to_mask_mm(size, spacing, inside);
  const float half = static_cast<float>(0.5 * stack.smallest_pixel_mm());
  for (std::size_t p = 0; p < out.mm.size(); ++p)
    out.mm[p] =
        inside[p] ? std::min(out.mm[p] - half, out.far_mm) : -std::min(to_label[p] - half, out.far_mm);
  return out;
}

}  // namespace

SliceStack take_slices(const LabelVolume& volume, int axis) {
  const auto [u, v] = slice_axes(axis);
  const Eigen::Vector3d spacing = volume.spacing_mm();
  SliceStack stack;
  stack.width = volume.size[u];
  stack.height = volume.size[v];
  stack.count = volume.size[static_cast<std::size_t>(axis)];
  stack.pixel_mm = {spacing[static_cast<int>(u)], spacing[static_cast<int>(v)]};
  stack.step_mm = spacing[axis];
  stack.pixels.reserve(volume.labels.size());
  in_slice_order(volume.size, axis,
                 [&](std::size_t offset) { stack.pixels.push_back(volume.labels[offset]); });
  return stack;
}

LabelVolume put_slices(const SliceStack& stack, const LabelVolume& source, int axis, int planes) {
  LabelVolume out;
  out.infos = source.infos;
  out.size = source.size;
  out.size[static_cast<std::size_t>(axis)] = stack.count;
  const Eigen::Vector3d step = source.linear().col(axis) / planes;
  out.index_to_mm = source.index_to_mm;
  out.index_to_mm.block<3, 1>(0, axis) = step;
  out.index_to_mm.block<3, 1>(0, 3) -= step * ((planes - 1) / 2);
  out.labels.resize(stack.pixels.size());
  std::size_t pixel = 0;
  in_slice_order(out.size, axis, [&](std::size_t offset) { out.labels[offset] = stack.pixels[pixel++]; });
  return out;
}

SliceDistances slice_distances(const SliceStack& stack, int slice, double far_mm) {
  const Label* pixels = stack.slice(slice);
  std::vector<Box> boxes(65536);
  std::size_t p = 0;
  for (int y = 0; y < stack.height; ++y)
    for (int x = 0; x < stack.width; ++x, ++p) {
      Box& box = boxes[pixels[p]];
      box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x), std::max(box.y1, y)};
    }
  SliceDistances out;
  for (std::size_t label = 0; label < boxes.size(); ++label)
    if (boxes[label].x1 >= 0)
      out.push_back(label_distance(stack, pixels, static_cast<Label>(label), boxes[label], far_mm));
  return out;
}

}  // namespace voxtet::slices
