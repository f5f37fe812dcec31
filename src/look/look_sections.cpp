#include "look/look_sections.h"

namespace kagefude {

bool actsIn(Scope scope, const LookSection& section) {
  switch (scope) {
    case Scope::look:
      return section.inLook != nullptr;
    case Scope::light:
      return section.inLight != nullptr;
    case Scope::style:
      return section.inStyle != nullptr;
  }
  return false;
}

bool actsIn(Scope scope, const LookSection& section, std::string_view key) {
  return actsIn(scope, section) && (scope == Scope::look || key != section.wholeLookKey);
}

}  // namespace kagefude
