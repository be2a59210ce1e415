// runtime/scene/gltf/file/tinygltf.cpp: the implementation of tinygltf, compiled once, without any
// image decoder.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_USE_CPP14
#include <nlohmann/json.hpp>

#include <tiny_gltf.h>
