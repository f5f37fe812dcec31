#pragma once

#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace kagefude {

/// What a parameter can hold. A choice is held as the index of its name.
using Value =
    std::variant<bool, int, double, std::string, std::vector<double>, std::vector<std::string>>;

enum class ValueType { boolean, integer, number, choice, text, numbers, texts };

/// One row of a pass's parameter table: the only place where a parameter is described. TOML keys,
/// `--set pass.key=value`, `kagefude passes`, range errors and the fuzz dictionary come from it.
/// The default is what a default-constructed parameter struct holds.
struct Parameter {
  std::string_view name;
  ValueType type;
  double minimum;  ///< smallest allowed number, inclusive; for `numbers` it bounds each of them
  double maximum;  ///< largest allowed number, inclusive
  std::string_view unit;
  std::string_view help;                      ///< one sentence
  std::span<const std::string_view> choices;  ///< names in the order of the enum's values
  size_t count;                               ///< how many numbers, for `numbers`; 0 = any
  Value (*get)(const void* params);
  void (*set)(void* params, const Value& value);
  Value (*defaultValue)();
};

/// A pass's table with its name (the look's section), one sentence, and its source.
struct ParameterTable {
  std::string_view pass;
  std::string_view summary;
  std::string_view source;
  std::span<const Parameter> parameters;
};

namespace detail {

template <class T>
struct MemberOf;
template <class Class, class Type>
struct MemberOf<Type Class::*> {
  using Owner = Class;
  using Field = Type;
};

template <class Field>
constexpr ValueType valueTypeOf() {
  if constexpr (std::is_same_v<Field, bool>) {
    return ValueType::boolean;
  } else if constexpr (std::is_enum_v<Field>) {
    return ValueType::choice;
  } else if constexpr (std::is_same_v<Field, int>) {
    return ValueType::integer;
  } else if constexpr (std::is_same_v<Field, float>) {
    return ValueType::number;
  } else if constexpr (std::is_same_v<Field, std::string>) {
    return ValueType::text;
  } else if constexpr (std::is_same_v<Field, std::vector<std::string>>) {
    return ValueType::texts;
  } else {
    return ValueType::numbers;
  }
}

template <auto Member>
struct Access {
  using Owner = typename MemberOf<decltype(Member)>::Owner;
  using Field = typename MemberOf<decltype(Member)>::Field;

  static Value toValue(const Field& field) {
    if constexpr (std::is_enum_v<Field>) {
      return static_cast<int>(field);
    } else if constexpr (std::is_same_v<Field, float>) {
      return static_cast<double>(field);
    } else if constexpr (valueTypeOf<Field>() == ValueType::numbers) {
      return std::vector<double>(field.begin(), field.end());
    } else {
      return field;
    }
  }
  static Value get(const void* params) {
    return toValue(static_cast<const Owner*>(params)->*Member);
  }
  static Value defaultValue() { return toValue(Owner{}.*Member); }
  static void set(void* params, const Value& value) {
    Field& field = static_cast<Owner*>(params)->*Member;
    if constexpr (std::is_enum_v<Field>) {
      field = static_cast<Field>(std::get<int>(value));
    } else if constexpr (std::is_same_v<Field, float>) {
      field = static_cast<float>(std::get<double>(value));
    } else if constexpr (valueTypeOf<Field>() == ValueType::numbers) {
      const auto& numbers = std::get<std::vector<double>>(value);
      field.assign(numbers.begin(), numbers.end());
    } else {
      field = std::get<Field>(value);
    }
  }
};

}  // namespace detail

/// A row for a number or integer member: `number<&PcfParams::radius>("radius", 0, 64, "texels",
/// "…")`. Values outside [minimum, maximum] are refused with the range in the message.
template <auto Member>
constexpr Parameter number(std::string_view name, double minimum, double maximum,
                           std::string_view unit, std::string_view help) {
  using A = detail::Access<Member>;
  return {name,
          detail::valueTypeOf<typename A::Field>(),
          minimum,
          maximum,
          unit,
          help,
          {},
          0,
          &A::get,
          &A::set,
          &A::defaultValue};
}

/// A row for a bool, std::string or std::vector<std::string> member.
template <auto Member>
constexpr Parameter plain(std::string_view name, std::string_view help) {
  using A = detail::Access<Member>;
  return {name,
          detail::valueTypeOf<typename A::Field>(),
          0,
          0,
          "",
          help,
          {},
          0,
          &A::get,
          &A::set,
          &A::defaultValue};
}

/// A row for an enum member whose values are 0, 1, 2 … in the order of `choices`. In Value a
/// choice travels as that index; names are looked up by the look's parser.
template <auto Member>
constexpr Parameter choice(std::string_view name, std::span<const std::string_view> choices,
                           std::string_view help) {
  using A = detail::Access<Member>;
  return {name, ValueType::choice, 0, 0, "", help, choices, 0, &A::get, &A::set, &A::defaultValue};
}

/// A row for a std::vector<float> member of `count` numbers (0: any count).
template <auto Member>
constexpr Parameter numbers(std::string_view name, size_t count, double minimum, double maximum,
                            std::string_view unit, std::string_view help) {
  using A = detail::Access<Member>;
  return {name,    ValueType::numbers, minimum, maximum, unit, help, {}, count, &A::get,
          &A::set, &A::defaultValue};
}

}  // namespace kagefude
