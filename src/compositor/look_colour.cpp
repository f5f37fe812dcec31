#include "compositor/look_colour.h"

#include "base/place_error.h"

namespace kagefude {

Colour colourOf(const Look& look) {
  const bool named = !look.colour.config.empty();
  return withPlace(named ? look.keyWithPlace("colour.config") : "",
                   [&] { return Colour(look.colourConfig()); });
}

}  // namespace kagefude
