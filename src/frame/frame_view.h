#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "exr/image_file.h"
#include "frame/frame_group.h"

namespace kagefude {

/// The views of a file: those that its headers list (multiView, the parts' own), in that order, or
/// left and right where the name of a known pass has them ("L.Position.left.X"). Empty for a file
/// of one view that does not say which.
std::vector<std::string> listViews(const ImageFile& file);

/// Takes one view of a file, as if it had been rendered alone: only its channels, under names
/// without it, its parts with their windows, its headers. Three layouts are known, also mixed: the
/// standard's ("N.right.X", "right.R"), Nuke's view prefix ("right.N.X"), and a part for each view.
/// Channels without a view are the default view's; where the default view is named too they are
/// common to all. An empty `view` is the default one: the first that the headers list. A file
/// without any view is taken as it is.
///
/// Throws InputError when the file has views, but not this one. Cost: the channel names.
ImageFile takeView(ImageFile file, const std::string& view);

/// A frame's file, joined with the `others` that belong to it, and of them one view: how every
/// frame is opened. Errors as openAnyImage, joinImages and takeView; those of the others begin with
/// what named them, such as a look's key.
ImageFile openFrame(const std::filesystem::path& path, const std::string& view = "",
                    const std::vector<GroupFile>& others = {}, const std::string& named = "");

namespace detail {

/// A name and the view that was cut out of it: before the last component ("N.right.X"), last
/// ("crypto_object.right"), or first ("right.N.X"). "" when it has none of `views`.
struct ViewedName {
  std::string name;
  std::string view;
};
ViewedName cutView(std::string_view name, const std::vector<std::string>& views);

}  // namespace detail
}  // namespace kagefude
