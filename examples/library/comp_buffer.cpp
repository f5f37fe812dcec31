// Comps a frame in memory and brightens it before it is written: comp_buffer LOOK FRAME OUTPUT.
#include <OpenImageIO/imagebufalgo.h>
#include <kagefude/imagebuf/comp_image.h>

#include <iostream>

int main(int argc, char** argv) try {
  if (argc != 4) throw std::runtime_error("usage: comp_buffer LOOK FRAME OUTPUT");
  const kagefude::ImageComp look(kagefude::readLook(argv[1], {}));
  const OIIO::ImageBuf frame(argv[2]);  // could as well come from a renderer
  std::vector<std::string> warnings;
  const OIIO::ImageBuf painted = look.comp(frame, 1, "", &warnings);
  for (const std::string& warning : warnings) std::cerr << warning << '\n';
  const OIIO::ImageBuf bright = OIIO::ImageBufAlgo::mul(painted, {1.5f, 1.5f, 1.5f, 1.0f});
  return bright.write(argv[3]) ? 0 : 1;
} catch (const std::exception& problem) {
  std::cerr << problem.what() << '\n';
  return 1;
}
