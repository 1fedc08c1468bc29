#include <tools/mesh_files/vertex_records.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>
#include <utility>

#include <tools/mesh_files/mesh_formats.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/little_endian.hpp>

namespace simdbezier::tools {

namespace {

RecordLayout::Field append(RecordLayout& layout, FieldType type, std::size_t components) {
  if (type == FieldType::none) {
    return {};
  }
  const RecordLayout::Field field{type, layout.size};
  layout.size += (size_of(type) * components + 3) / 4 * 4;
  return field;
}

RecordLayout records(FieldType position, FieldType normal, FieldType uv, FieldType st,
                     FieldType patch) {
  RecordLayout layout;
  layout.position = append(layout, position, 3);
  layout.normal = append(layout, normal, 3);
  layout.uv = append(layout, uv, 2);
  layout.st = append(layout, st, 2);
  layout.patch = append(layout, patch, 1);
  return layout;
}

// Rounds to the nearest integer of the range; the value leaves it by rounding errors at most.
template <typename Stored, typename T>
Stored to_normalised(T number) {
  const auto value = static_cast<double>(number);
  constexpr double kMost = std::numeric_limits<Stored>::max();
  const double least = std::is_signed_v<Stored> ? -kMost : 0;
  return static_cast<Stored>(std::clamp(std::nearbyint(value * kMost), least, kMost));
}

} // namespace

std::size_t size_of(FieldType type) noexcept {
  switch (type) {
  case FieldType::none:
    return 0;
  case FieldType::i8:
    return 1;
  case FieldType::i16:
  case FieldType::u16:
    return 2;
  case FieldType::f32:
  case FieldType::u32:
    return 4;
  case FieldType::f64:
    break;
  }
  return 8;
}

template <typename T>
RecordLayout exact_records(const MeshContents& contents, bool uv_twice) {
  const FieldType type =
      sizeof(T) == sizeof(float) || contents.floats ? FieldType::f32 : FieldType::f64;
  const FieldType uv = contents.uv ? type : FieldType::none;
  return records(type, contents.normals ? type : FieldType::none, uv,
                 uv_twice ? uv : FieldType::none,
                 contents.patches > 0 ? FieldType::u32 : FieldType::none);
}

RecordLayout glb_records(const MeshContents& contents) {
  const bool full = contents.storage == VertexStorage::full;
  const FieldType narrow =
      contents.storage == VertexStorage::quantised_8 ? FieldType::i8 : FieldType::i16;
  const FieldType normal = full ? FieldType::f32 : narrow;
  const FieldType other = full ? FieldType::f32 : FieldType::u16;
  RecordLayout layout = records(other, contents.normals ? normal : FieldType::none,
                                contents.uv ? other : FieldType::none, FieldType::none,
                                contents.patches > 0 ? FieldType::f32 : FieldType::none);
  layout.unit_normals = contents.normals;
  return layout;
}

RecordLayout float_positions() {
  RecordLayout layout;
  layout.position = append(layout, FieldType::f32, 3);
  return layout;
}

QuantisedSpace quantised_space(const MeshBox& box) {
  QuantisedSpace space{box.low, 0};
  for (std::size_t c = 0; c < 3; ++c) {
    space.extent = std::max(space.extent, box.high[c] - box.low[c]);
  }
  space.extent = space.extent > 0 ? space.extent : 1; // one point, which any scale holds
  return space;
}

template <typename T>
RecordPacker<T>::RecordPacker(std::string path, const MeshContents& contents,
                              const RecordLayout& layout)
    : path_(std::move(path)), contents_(contents), layout_(layout),
      space_(contents.box ? quantised_space(*contents.box) : QuantisedSpace()),
      records_are_values_(std::endian::native == std::endian::little &&
                          layout == exact_records<T>(contents, false) &&
                          layout.size == contents.stride() * sizeof(T)) {}

template <typename T>
std::span<const std::byte> RecordPacker<T>::pack(const VertexBlock<T>& block) {
  if (records_are_values_ || block.values.empty()) {
    return std::as_bytes(block.values);
  }
  records_.assign(block.values.size() / contents_.stride() * layout_.size, std::byte{0});
  pack_positions(block.values);
  // glTF asks for unit length, so where there is no normal (status `degenerate`) it gets any.
  constexpr std::array<T, 3> kUpwards = {0, 0, 1};
  pack_numbers(layout_.normal, block.values.subspan(3), 3, [&](const T* n, std::size_t c) {
    return layout_.unit_normals && n[0] == 0 && n[1] == 0 && n[2] == 0 ? kUpwards[c] : n[c];
  });
  for (const RecordLayout::Field& field : {layout_.uv, layout_.st}) {
    pack_numbers(field, block.values.subspan(contents_.normals ? 6 : 3), 2,
                 [](const T* uv, std::size_t c) { return uv[c]; });
  }
  pack_patches(block.patch);
  return records_;
}

template <typename T>
void RecordPacker<T>::pack_positions(std::span<const T> values) {
  if (layout_.position.type != FieldType::u16) {
    return pack_numbers(layout_.position, values, 3,
                        [](const T* p, std::size_t c) { return p[c]; });
  }
  const double beyond = contents_.margin / space_.extent;
  pack_numbers(layout_.position, values, 3, [&](const T* p, std::size_t c) {
    const double place = (static_cast<double>(p[c]) - space_.low[c]) / space_.extent;
    if (!(place >= -beyond && place <= 1 + beyond)) {
      bad_input(path_ + ": expected positions within their box, found one outside of it");
    }
    return place;
  });
}

template <typename T>
void RecordPacker<T>::pack_patches(std::span<const std::uint32_t> patch) {
  std::byte* to = records_.data() + layout_.patch.offset;
  for (const std::uint32_t number : patch) {
    if (layout_.patch.type == FieldType::f32) {
      store_little(to, static_cast<float>(number));
    } else if (layout_.patch.type == FieldType::u32) {
      store_little(to, number);
    }
    to += layout_.size;
  }
}

// Calls source(values of a vertex, component) for every number of the field.
template <typename T>
template <typename Source>
void RecordPacker<T>::pack_numbers(const RecordLayout::Field& field, std::span<const T> values,
                                   std::size_t count, Source&& source) {
  const auto store = [&]<typename Convert>(const Convert& convert) {
    std::byte* record = records_.data() + field.offset;
    for (std::size_t k = 0; k < values.size(); k += contents_.stride(), record += layout_.size) {
      for (std::size_t c = 0; c < count; ++c) {
        const auto number = convert(source(&values[k], c));
        store_little(record + c * sizeof number, number);
      }
    }
  };
  switch (field.type) {
  case FieldType::f32:
    return store([&](auto value) { return as_float(path_, value); });
  case FieldType::f64:
    return store([](auto value) { return static_cast<double>(value); });
  case FieldType::u16:
    return store([](auto value) { return to_normalised<std::uint16_t>(value); });
  case FieldType::i16:
    return store([](auto value) { return to_normalised<std::int16_t>(value); });
  case FieldType::i8:
    return store([](auto value) { return to_normalised<std::int8_t>(value); });
  case FieldType::none:
  case FieldType::u32: // patch numbers only
    return;
  }
}

template <typename Stored>
void StoredBounds::include_as(std::span<const std::byte> records) {
  for (std::size_t at = layout_.position.offset; at < records.size(); at += layout_.size) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto value =
          static_cast<double>(load_little<Stored>(&records[at + c * sizeof(Stored)]));
      low_[c] = std::min(low_[c], value);
      high_[c] = std::max(high_[c], value);
    }
  }
}

void StoredBounds::include(std::span<const std::byte> records) {
  layout_.position.type == FieldType::u16 ? include_as<std::uint16_t>(records)
                                          : include_as<float>(records);
}

template RecordLayout exact_records<float>(const MeshContents&, bool);
template RecordLayout exact_records<double>(const MeshContents&, bool);
template class RecordPacker<float>;
template class RecordPacker<double>;

} // namespace simdbezier::tools
