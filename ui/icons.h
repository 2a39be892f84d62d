#pragma once
// The icons in use, by what they stand for. Font Awesome glyphs, merged into the text font by
// ui/theme.cpp.

#include <icons_font_awesome_6.h>

namespace lightbench::ui::icon {

inline constexpr const char* kAdd = ICON_FA_PLUS;
inline constexpr const char* kCamera = ICON_FA_CAMERA;
inline constexpr const char* kClose = ICON_FA_XMARK;
inline constexpr const char* kCopy = ICON_FA_COPY;
inline constexpr const char* kEnvironment = ICON_FA_GLOBE;
inline constexpr const char* kEye = ICON_FA_EYE;
inline constexpr const char* kEyeOff = ICON_FA_EYE_SLASH;
inline constexpr const char* kFile = ICON_FA_FILE;
inline constexpr const char* kFit = ICON_FA_EXPAND;
inline constexpr const char* kFolder = ICON_FA_FOLDER;
inline constexpr const char* kImage = ICON_FA_IMAGE;
inline constexpr const char* kLight = ICON_FA_LIGHTBULB;
inline constexpr const char* kMaterial = ICON_FA_CIRCLE_HALF_STROKE;
inline constexpr const char* kMedium = ICON_FA_CLOUD;
inline constexpr const char* kObject = ICON_FA_CUBE;
inline constexpr const char* kPause = ICON_FA_PAUSE;
inline constexpr const char* kPlay = ICON_FA_PLAY;
inline constexpr const char* kRemove = ICON_FA_TRASH;
inline constexpr const char* kRestart = ICON_FA_ARROW_ROTATE_RIGHT;
inline constexpr const char* kTexture = ICON_FA_CHESS_BOARD;
inline constexpr const char* kWarning = ICON_FA_TRIANGLE_EXCLAMATION;

}  // namespace lightbench::ui::icon
