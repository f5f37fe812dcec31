#include "exr/attributes.h"

#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFloatVectorAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfRationalAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfTimeCodeAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

#include "exr/reserved_attributes.h"

namespace kagefude::detail {
namespace {

template <class Attribute>
const auto* valueOf(const Imf::Attribute& attribute) {
  const auto* typed = dynamic_cast<const Attribute*>(&attribute);
  return typed ? &typed->value() : nullptr;
}

template <class Number, size_t size, class Vector>
std::array<Number, size> numbersOf(const Vector& vector) {
  std::array<Number, size> numbers;
  for (size_t i = 0; i < size; ++i) numbers[i] = vector[static_cast<int>(i)];
  return numbers;
}

template <size_t rows, class Matrix>
std::array<float, rows * rows> rowsOf(const Matrix& matrix) {
  std::array<float, rows * rows> numbers;
  for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = matrix.x[i / rows][i % rows];
  return numbers;
}

std::array<float, 8> colourOf(const Imf::Chromaticities& c) {
  return {c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x, c.white.y};
}

std::optional<ExrValue> vectorOrMatrix(const Imf::Attribute& a) {
  if (const auto* v = valueOf<Imf::V2iAttribute>(a)) return numbersOf<int32_t, 2>(*v);
  if (const auto* v = valueOf<Imf::V3iAttribute>(a)) return numbersOf<int32_t, 3>(*v);
  if (const auto* v = valueOf<Imf::V2fAttribute>(a)) return numbersOf<float, 2>(*v);
  if (const auto* v = valueOf<Imf::V3fAttribute>(a)) return numbersOf<float, 3>(*v);
  if (const auto* v = valueOf<Imf::M33fAttribute>(a)) return rowsOf<3>(*v);
  if (const auto* v = valueOf<Imf::M44fAttribute>(a)) return rowsOf<4>(*v);
  if (const auto* v = valueOf<Imf::ChromaticitiesAttribute>(a)) return colourOf(*v);
  return std::nullopt;
}

std::optional<ExrValue> convert(const Imf::Attribute& a) {
  if (const auto* v = valueOf<Imf::StringAttribute>(a)) return *v;
  if (const auto* v = valueOf<Imf::IntAttribute>(a)) return int32_t{*v};
  if (const auto* v = valueOf<Imf::FloatAttribute>(a)) return *v;
  if (const auto* v = valueOf<Imf::DoubleAttribute>(a)) return *v;
  if (const auto* v = valueOf<Imf::StringVectorAttribute>(a)) return *v;
  if (const auto* v = valueOf<Imf::FloatVectorAttribute>(a)) return *v;
  if (const auto* v = valueOf<Imf::RationalAttribute>(a)) return ExrRational{v->n, v->d};
  if (const auto* v = valueOf<Imf::TimeCodeAttribute>(a)) {
    return ExrTimeCode{v->timeAndFlags(), v->userData()};
  }
  return vectorOrMatrix(a);
}

}  // namespace

std::optional<std::vector<ExrAttribute>> fastAttributes(const Imf::Header& header) {
  std::vector<ExrAttribute> attributes;
  for (auto a = header.begin(); a != header.end(); ++a) {
    if (isFromImage(a.name())) continue;
    auto value = convert(a.attribute());
    if (!value) return std::nullopt;
    attributes.push_back({a.name(), *std::move(value)});
  }
  return attributes;
}

}  // namespace kagefude::detail
