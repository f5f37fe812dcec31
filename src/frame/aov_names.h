#pragma once

#include <array>
#include <string>
#include <string_view>

#include "frame/aov_resolver.h"

namespace kagefude::detail {

/// The kinds that have names to be found by, in the order in which they are told.
inline constexpr std::array<AovKind, 15> searchedKinds = {
    AovKind::position,     AovKind::normal,         AovKind::depth,
    AovKind::objectIndex,  AovKind::materialIndex,  AovKind::vector,
    AovKind::albedo,       AovKind::beauty,         AovKind::shadow,
    AovKind::cryptoObject, AovKind::cryptoMaterial, AovKind::rest,
    AovKind::uv,           AovKind::instanceRandom, AovKind::emission};

/// A name as the tables know it: lower case, without "_", "-" and spaces.
std::string plainName(std::string_view name);

/// How early in the table of a kind's known names a pass name stands; -1: not in it.
int aliasRank(AovKind kind, std::string_view passName);

/// Whether any renderer that we know calls a pass so; crypto layers with their two digits too.
bool isKnownPass(std::string_view passName);

/// Order of a component in its pass (x y z w; r g b a; u v a), or -1 when the text is no component.
int componentOrder(std::string_view suffix);

/// "CryptoObject00" gives "CryptoObject"; other names give "".
std::string_view cryptomatteStem(std::string_view passName);

}  // namespace kagefude::detail
