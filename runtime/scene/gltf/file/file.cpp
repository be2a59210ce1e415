// runtime/scene/gltf/file/file.cpp: .gltf and .glb files through tinygltf, kept within limits.
#include "runtime/scene/gltf/file/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <map>
#include <span>

#include "runtime/base/numbers.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/uri/package_uri.h"
#include "runtime/base/uri/percent_encoding.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/gltf/file/check.h"
#include "runtime/scene/gltf/file/extensions.h"
#include "runtime/scene/gltf/file/indices.h"
#include "runtime/scene/gltf/file/json_scan.h"

namespace kinora {

namespace {

namespace fs = std::filesystem;

// "" or why not.
std::string read_bytes(const std::string& path, size_t limit, std::vector<unsigned char>& bytes) {
    uint64_t size = 0;
    std::string error;
    OpenFile file = open_regular_file(path, size, &error);
    if (!file) return error;
    if (size > kMaxGltfBytes) return "it is larger than 2 GB";
    bytes.resize(std::min(size_t(size), limit));
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
    return "";
}

std::string read_source(const SceneSource& source, std::vector<unsigned char>& bytes) {
    if (!source.bytes) return read_bytes(source.path, kMaxGltfBytes, bytes);
    if (source.bytes->size() > kMaxGltfBytes) return "it is larger than 2 GB";
    bytes.assign(source.bytes->begin(), source.bytes->end());
    return "";
}

std::string_view text_of(const std::vector<unsigned char>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

uint32_t little_endian_32(const unsigned char* at) {
    return uint32_t(at[0]) | uint32_t(at[1]) << 8 | uint32_t(at[2]) << 16 | uint32_t(at[3]) << 24;
}

constexpr uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a;  // glTF 2.0, 4.4

bool is_binary(const std::vector<unsigned char>& bytes) {
    return bytes.size() >= 4 && little_endian_32(bytes.data()) == kMagic;
}

// The JSON of a .glb: the first chunk; "" or why there is none.
std::string json_chunk(const std::vector<unsigned char>& bytes, std::string_view& json) {
    if (bytes.size() < 20) return "the .glb ends in its header";
    uint32_t version = little_endian_32(&bytes[4]), length = little_endian_32(&bytes[8]);
    if (version != 2) return fmt::format("the .glb has version {}, not 2", version);
    if (length > bytes.size())
        return fmt::format("the .glb says it has {} bytes and has {}", length, bytes.size());
    uint32_t size = little_endian_32(&bytes[12]);
    if (little_endian_32(&bytes[16]) != kJsonChunk)
        return "the first chunk of the .glb is not JSON";
    if (size > length - 20) return "the JSON chunk reaches past the end of the .glb";
    json = {reinterpret_cast<const char*>(&bytes[20]), size};
    return "";
}

// What tinygltf's callbacks may read, and what they did.
struct Guard {
    const ImportOptions& options;
    Diagnostics& diagnostics;
    GltfFile& file;
    // A buffer's file may be longer than the buffer (glTF 2.0, 3.6.1.1); tinygltf wants it exact.
    std::map<std::string, size_t> sizes;

    size_t wanted_bytes(const std::string& path) const;
};

size_t Guard::wanted_bytes(const std::string& path) const {
    auto wanted = sizes.find(path);
    size_t left = kMaxGltfBytes - std::min(file.bytes, kMaxGltfBytes);
    return wanted == sizes.end() ? left : std::min(left, wanted->second);
}

bool may_read(const Guard& guard, const std::string& path) {
    return may_read_gltf(guard.file, guard.options, path);
}

bool file_exists(const std::string& path, void* user) {
    const Guard& guard = *static_cast<const Guard*>(user);
    if (!is_regular_file(path)) return false;
    if (may_read(guard, path)) return true;
    guard.diagnostics.report(Code::GLTF_FILE, gltf_location(guard.file, "/buffers"), path,
                             "it lies outside the scene's folder");
    return false;
}

std::string same_path(const std::string& path, void*) {
    return path;
}

bool read_file(std::vector<unsigned char>* out, std::string* error, const std::string& path,
               void* user) {
    Guard& guard = *static_cast<Guard*>(user);
    if (!may_read(guard, path)) return false;
    std::string plain = fs::path(path).lexically_normal().string();
    *error = read_bytes(path, guard.wanted_bytes(plain), *out);
    if (const char* what = disguise_of(text_of(*out)); what && error->empty()) *error = what;
    guard.file.bytes += out->size();
    guard.file.files.push_back(plain);
    return error->empty();
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

// Keeps the bytes of data URIs as they are. Those in buffer views are read from the model later:
// tinygltf hands them over unchecked.
bool keep_image(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                const unsigned char* bytes, int size, void*) {
    image->as_is = true;
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

constexpr size_t kQuotedData = 40;  // characters of a data URI that a message holds

// tinygltf's or the JSON parser's words as one line, and the position that the parser names.
Location error_location(const GltfFile& file, std::string& error) {
    while (!error.empty() && (error.back() == '\n' || error.back() == ' ')) error.pop_back();
    for (char& c : error)
        if (c == '\n') c = ' ';
    if (error.starts_with("[json.exception")) error.erase(0, error.find("] ") + 2);
    for (size_t at = 0; (at = error.find("data:", at)) != error.npos; at += kQuotedData) {
        size_t end = std::min(error.find(' ', at), error.size());
        if (end - at > kQuotedData) error.replace(at + kQuotedData, end - at - kQuotedData, "...");
    }
    if (error.size() > 300) error.resize(300);
    auto number_behind = [&](std::string_view words) {
        const size_t at = error.find(words);
        if (at == error.npos) return std::optional<int>();
        std::string_view rest = std::string_view(error).substr(at + words.size());
        return take_number<int>(rest);
    };
    const std::optional<int> named = number_behind("at line "), column = number_behind(", column ");
    if (!named || !column) return gltf_location(file, "");
    size_t offset = 0;
    for (int line = *named; line > 1 && offset < file.json.size(); ++offset)
        line -= file.json[offset] == '\n';
    offset = std::min(offset + size_t(std::max(*column - 1, 0)), file.json.size());
    return {file.file, uint32_t(offset), uint32_t(offset)};
}

bool load_model(const std::vector<unsigned char>& bytes, std::span<const char> json, Guard& guard,
                std::string& error) {
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({file_exists, same_path, read_file, write_nothing, &guard});
    loader.SetImageLoader(keep_image, nullptr);
    std::string warning;
    GltfFile& file = guard.file;
    try {
        bool loaded = is_binary(bytes)
                          ? loader.LoadBinaryFromMemory(&file.model, &error, &warning, bytes.data(),
                                                        unsigned(bytes.size()), file.directory)
                          : loader.LoadASCIIFromString(&file.model, &error, &warning, json.data(),
                                                       unsigned(json.size()), file.directory);
        if (!loaded && error.empty()) error = "it cannot be read";
        return loaded;
    } catch (const std::bad_alloc&) {
        error = "not enough memory";
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    return false;
}

// "" or why a file of that version is not read (glTF 2.0, 3.2): others of version 2 are, unless
// they say that a reader must know more.
std::string check_version(std::string_view json) {
    auto number = [&](const char* pointer) {
        std::optional<JsonRange> range = json_find(json, pointer);
        SourceMap map;
        return range ? json_string(json, *range, kNoFile, map) : std::string();
    };
    std::string version = number("/asset/version"), least = number("/asset/minVersion");
    for (const char* list : {"/nodes", "/meshes", "/scenes"})
        if (std::optional<JsonRange> range = json_find(json, list);
            version.empty() && range && json[range->begin] == '{')
            return "it is one of glTF 1.0, whose lists are objects";
    if (!version.empty() && version != "2" && !version.starts_with("2."))
        return fmt::format("its version is {}", version);
    if (!least.empty() && least != "2" && least != "2.0")
        return fmt::format("it asks for a reader of version {}", least);
    return "";
}

// The bytes of the file with another JSON in them (glTF 2.0, 4.4).
std::vector<unsigned char> with_json(const std::vector<unsigned char>& bytes, std::string json) {
    if (!is_binary(bytes)) return {json.begin(), json.end()};
    const size_t old_end = 20 + little_endian_32(&bytes[12]);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::vector<unsigned char> out(bytes.begin(), bytes.begin() + 20);
    out.insert(out.end(), json.begin(), json.end());
    out.insert(out.end(), bytes.begin() + ptrdiff_t(std::min(old_end, bytes.size())), bytes.end());
    for (auto [at, number] : {std::pair{8, out.size()}, std::pair{12, json.size()}})
        for (int b = 0; b < 4; ++b) out[size_t(at + b)] = uint8_t(number >> 8 * b);
    return out;
}

void report_indices(const GltfFile& file, const GltfIndices& indices, Diagnostics& diagnostics) {
    for (const GltfIndexFault& fault : indices.faults) {
        const Location where{file.file, fault.range.begin, fault.range.end};
        Finding& finding =
            fault.name ? diagnostics.report(Code::GLTF_REFERENCE, where, fault.name, fault.value)
                       : diagnostics.report(Code::GLTF_VALUE, where,
                                            fmt::format("'{}' is no object; it is left out",
                                                        fault.pointer.substr(1)));
        finding.id_path = fault.pointer;
    }
    if (indices.fault_count > indices.faults.size())
        diagnostics.report(Code::GLTF_MORE, gltf_location(file, ""),
                           indices.fault_count - indices.faults.size());
}

// False, with a finding each (the first hundred), where files of buffers are missing.
bool has_buffer_files(const GltfFile& file, std::span<const GltfBuffer> buffers,
                      Diagnostics& diagnostics) {
    size_t missing = 0;
    for (size_t b = 0; b < buffers.size() && missing < kMaxGltfFindings; ++b) {
        std::error_code code;
        if (buffers[b].uri.empty() || fs::exists(gltf_path(file, buffers[b].uri), code)) continue;
        const std::string pointer = fmt::format("/buffers/{}/uri", b);
        diagnostics
            .report(Code::GLTF_BUFFER_FILE, gltf_location(file, pointer),
                    percent_decode(buffers[b].uri), b)
            .id_path = pointer;
        ++missing;
    }
    return missing == 0;
}

}  // namespace

std::string gltf_path(const GltfFile& file, const std::string& uri) {
    std::string path = percent_decode(uri);
    if (path.empty() || path.find('\0') != std::string::npos) return "";
    if (std::string found = path_of_package_uri(path, file.directory); !found.empty()) return found;
    if (path.front() != '/') path = file.directory + path;
    return fs::path(path).lexically_normal().string();
}

bool may_read_gltf(const GltfFile& file, const ImportOptions& options, const std::string& path) {
    std::error_code code;
    auto real = [&](const std::string& name) {
        fs::path whole = fs::weakly_canonical(fs::absolute(name.empty() ? "." : name), code);
        return whole.has_relative_path() && whole.filename().empty() ? whole.parent_path() : whole;
    };
    auto inside = [&](const std::string& folder) {
        fs::path relative = real(path).lexically_relative(real(folder));
        return !code && !relative.empty() && *relative.begin() != "..";
    };
    return inside(file.directory) ||
           std::any_of(options.allow_external.begin(), options.allow_external.end(), inside);
}

Location gltf_location(const GltfFile& file, const std::string& pointer) {
    if (file.file == kNoFile) return {};
    std::optional<JsonRange> range = json_nearest(file.json, pointer);
    if (!range) return {file.file, 0, 0};
    return {file.file, range->begin, pointer.empty() ? range->begin + 1 : range->end};
}

std::optional<GltfFile> read_gltf_file(const SceneSource& source, const ImportOptions& options,
                                       Diagnostics& diagnostics) {
    GltfFile file;
    const std::string& path = source.path;
    file.path = path;
    size_t slash = path.rfind('/');
    file.directory = slash == std::string::npos ? "" : path.substr(0, slash + 1);
    auto fail = [&](const std::string& why) {
        if (file.file == kNoFile) file.file = diagnostics.files.add(path, "");
        std::string text = why;
        Location where = error_location(file, text);
        diagnostics.report(Code::GLTF_INVALID, where, text);
        return std::nullopt;
    };
    std::vector<unsigned char> bytes;
    if (std::string error = read_source(source, bytes); !error.empty()) return fail(error);
    if (bytes.empty()) return fail("the file is empty");
    file.bytes = bytes.size();
    file.files.push_back(path);
    std::string_view json = text_of(bytes);
    if (const char* what = disguise_of(json)) return fail(what);
    if (is_binary(bytes)) {
        if (std::string error = json_chunk(bytes, json); !error.empty()) return fail(error);
    } else if (json.starts_with("\xef\xbb\xbf")) {
        json.remove_prefix(3);
    }
    file.file = diagnostics.files.add(path, std::string(json));
    file.json = diagnostics.files.text(file.file);
    std::string error = check_gltf_shape(file.json, bytes.size());
    if (error.empty()) error = check_version(file.json);
    if (!error.empty()) return fail(error);
    // What is required of readers says why buffers and accessors look broken to one without it.
    if (!check_extensions(file, options, diagnostics)) return std::nullopt;
    error = check_gltf_json(file.json, is_binary(bytes));
    if (!error.empty()) return fail(error);
    const GltfIndices indices = check_gltf_indices(file.json);
    if (!indices.not_a_list.empty()) {
        diagnostics
            .report(Code::GLTF_INVALID, gltf_location(file, indices.not_a_list),
                    fmt::format("'{}' is not an array", indices.not_a_list.substr(1)))
            .id_path = indices.not_a_list;
        return std::nullopt;
    }
    report_indices(file, indices, diagnostics);
    const std::vector<GltfBuffer> buffers = gltf_buffers(file.json);
    if (!has_buffer_files(file, buffers, diagnostics)) return std::nullopt;
    Guard guard{options, diagnostics, file, {}};
    for (const GltfBuffer& buffer : buffers)
        if (!buffer.uri.empty()) guard.sizes[gltf_path(file, buffer.uri)] = buffer.bytes;
    // As it stands in `bytes`, a .glb's among its other chunks.
    size_t begin = size_t(json.data() - reinterpret_cast<const char*>(bytes.data()));
    size_t length = json.size();
    if (!indices.mended.empty()) {
        bytes = with_json(bytes, indices.mended);
        begin = is_binary(bytes) ? 20 : 0;
        length = indices.mended.size();
    }
    std::span<char> own(reinterpret_cast<char*>(bytes.data()) + begin, length);
    cut_gltf_data(own);
    if (!load_model(bytes, own, guard, error)) return fail(error);
    return file;
}

}  // namespace kinora
