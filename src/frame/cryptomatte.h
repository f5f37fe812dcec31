#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "exr/image_file.h"
#include "exr/read_channels.h"
#include "image/plane.h"

namespace kagefude {

/// MurmurHash3, x86, 32 bit (Austin Appleby's public-domain function), of the bytes of `text`.
uint32_t murmurHash3(std::string_view text, uint32_t seed = 0);

/// The id that Cryptomatte writes for a name: its hash, with the exponent's lowest bit flipped when
/// the bits would be a NaN, an infinity, zero or a denormal float ("uint32_to_float32", Cryptomatte
/// specification 1.2).
uint32_t cryptomatteId(std::string_view name);

/// A Cryptomatte as the header and the channel names show it.
struct Cryptomatte {
  std::string key;   ///< "cryptomatte/<key>", as its attributes begin; "" when it has none
  std::string name;  ///< layer name, for instance "ViewLayer.CryptoObject"
  std::vector<std::string> idChannels;        ///< by rank
  std::vector<std::string> coverageChannels;  ///< by rank
  int part = 0;                               ///< whose header describes it
  std::string fault;                          ///< which channel is missing, in a sentence; or ""
};

/// All Cryptomattes of a file: those that the metadata names and that have channels, then those
/// that only channel names show (a layer of r, g, b, a that ends in two digits, with "crypto" in
/// its name, in any case). Throws nothing.
std::vector<Cryptomatte> listCryptomattes(const ImageFile& file);

/// Those of a file that lack channels, with what is left of them, which may be no rank at all.
std::vector<Cryptomatte> brokenCryptomattes(const ImageFile& file);

/// Names by id, from the manifest in the header or in the file beside the image that it names. A
/// missing, broken or misplaced (absolute path, "..") manifest gives no names and a warning.
struct Manifest {
  std::map<uint32_t, std::string> names;
  std::vector<std::string> warnings;
};
Manifest readManifest(const ImageFile& file, const Cryptomatte& cryptomatte);

/// The file beside the image that readManifest would open for its names, whether it is there or
/// not; nothing when the header holds them itself, names none, or names one outside of the folder.
std::optional<std::filesystem::path> manifestFile(const ImageFile& file,
                                                  const Cryptomatte& cryptomatte);

/// Ids and coverage by rank, each of the data window's size. Id 0 is background.
struct CryptomattePlanes {
  std::vector<Labels> ids;
  std::vector<Floats> coverage;
  std::map<uint32_t, std::string> names;
  std::vector<std::string> warnings;
};

/// Reads a Cryptomatte by its name, exact or without its layer ("CryptoObject"), at most `ranks`
/// ranks (0: all). Throws InputError when there is none of that name (naming the nearest), when
/// two layers have it, when an id channel is half float, which destroys ids (naming the channel),
/// or when metadata states a hash or conversion other than the standard's.
CryptomattePlanes readCryptomatte(const ImageFile& file, std::string_view name, int ranks = 0);

/// The same, but the planes are only noted with the reader and hold pixels after its read().
CryptomattePlanes requestCryptomatte(ChannelReader& reader, std::string_view name, int ranks = 0);

/// The id with the most coverage at each pixel; equal coverage goes to the lower rank; no coverage
/// gives 0. One rank: that rank's ids where covered.
Labels dominantIds(const CryptomattePlanes& planes);

/// The ids whose manifest names match the pattern, rising. A pattern without * or ? also gives its
/// own hash, so plain names work without a manifest.
std::vector<uint32_t> matchingIds(const std::map<uint32_t, std::string>& names,
                                  std::string_view pattern);

}  // namespace kagefude
