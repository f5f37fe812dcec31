#include "picture/draw_text.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <filesystem>
#include <memory>
#include <vector>

#include "base/error.h"

namespace kagefude {
namespace {

constexpr const char* fontFiles[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
};

std::string findFont() {
  for (const char* file : fontFiles)
    if (std::filesystem::exists(file)) return file;
  throw InputError(
      fmt::format("no font to write labels with: expected {} (Debian package "
                  "fonts-dejavu-core)",
                  fontFiles[0]));
}

/// A font file at one size, with the library that it needs.
class Face {
 public:
  Face(const std::string& file, int size) {
    if (FT_Init_FreeType(&library_) != 0) throw std::bad_alloc();
    if (FT_New_Face(library_, file.c_str(), 0, &face_) != 0 ||
        FT_Set_Pixel_Sizes(face_, static_cast<FT_UInt>(size), 0) != 0) {
      FT_Done_FreeType(library_);
      throw InputError(fmt::format("the font {} cannot be used", file));
    }
  }
  ~Face() { FT_Done_FreeType(library_); }
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;

  /// The glyph of a character as grey, or null when the font cannot draw it.
  FT_GlyphSlot glyph(char32_t character) const {
    return FT_Load_Char(face_, character, FT_LOAD_RENDER) == 0 ? face_->glyph : nullptr;
  }

 private:
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

/// The characters of UTF-8 text; bytes that are none stand for themselves.
std::vector<char32_t> charactersOf(const std::string& text) {
  std::vector<char32_t> characters;
  size_t more = 0;
  for (const char byte : text) {
    const auto value = static_cast<unsigned char>(byte);
    if (more > 0 && (value & 0xC0u) == 0x80u) {
      characters.back() = characters.back() << 6 | (value & 0x3Fu);
      --more;
      continue;
    }
    more = value >= 0xF0u ? 3 : value >= 0xE0u ? 2 : value >= 0xC0u ? 1 : 0;
    characters.push_back(more > 0 ? value & (0x3Fu >> more) : value);
  }
  return characters;
}

void blend(const FT_Bitmap& glyph, View<float> picture, int left, int top) {
  for (int y = 0; y < static_cast<int>(glyph.rows); ++y)
    for (int x = 0; x < static_cast<int>(glyph.width); ++x) {
      if (!picture.contains(left + x, top + y)) continue;
      const float cover = static_cast<float>(glyph.buffer[y * glyph.pitch + x]) / 255.0f;
      float& value = picture(left + x, top + y);
      value += (1.0f - value) * cover;
    }
}

}  // namespace

void drawText(View<float> picture, int x, int y, int size, const std::string& text) {
  const Face face(findFont(), size);
  for (const char32_t character : charactersOf(text)) {
    const FT_GlyphSlot glyph = face.glyph(character);
    if (!glyph) continue;
    blend(glyph->bitmap, picture, x + glyph->bitmap_left, y - glyph->bitmap_top);
    x += static_cast<int>(glyph->advance.x >> 6);
  }
}

}  // namespace kagefude
