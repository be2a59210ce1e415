// runtime/scene/description/default_lights.h: what the lights are called that scenes without any
// get.
#pragma once

namespace kinora {

inline constexpr const char* kKeyLight = "default key light";
inline constexpr const char* kFillLight = "default fill light";
inline constexpr const char* kRimLight = "default rim light";
inline constexpr const char* kGreyWorld = "grey world";
// What other surfaces reflect, where it is asked for (--gi).
inline constexpr const char* kIndirectLight = "indirect light";
// What lies around the scene, where something does (--environment).
inline constexpr const char* kEnvironment = "environment";
// The node that carries the first three.
inline constexpr const char* kDefaultLightNode = "default light";

}  // namespace kinora
