// runtime/player/session/session_file.cpp: sessions as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "runtime/base/file_extension.h"
#include "runtime/base/files/temporary_file.h"
#include "runtime/player/session/session.h"
#include "runtime/scene/images/png_memory.h"

namespace kinora {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
using PathMap = std::function<std::string(const std::string&)>;

constexpr int kVersion = 1;
constexpr const char* kVersionName = "kinora_session";
constexpr int kMostPixels = 65536;  // a side

// Files that options name: the text behind these.
constexpr const char* kPathOptions[] = {"--imager=", "--atmosphere=", "--allow-external=", "-I"};

// Every path of a session. `map` is given those alone that may be files.
void map_paths(Session& session, const PathMap& map) {
    session.scene = map(session.scene);
    for (SceneEdits::Text& text : session.edits.texts)
        if (!text.file.empty()) text.file = map(text.file);
    auto map_shader = [&](const std::string& shader) {
        return has_extension(shader, {".sl"}) ? map(shader) : shader;
    };
    for (auto& [material, shader] : session.edits.shaders) shader = map_shader(shader);
    for (std::string& word : session.options) {
        if (word.starts_with("--shader=")) {
            size_t at = word.find('=', std::strlen("--shader=")) + 1;
            if (at > 0) word = word.substr(0, at) + map_shader(word.substr(at));
        }
        for (const char* option : kPathOptions) {
            if (!word.starts_with(option)) continue;
            std::string value = word.substr(std::strlen(option));
            bool folder = std::strcmp(option, "-I") == 0 || value.find('/') != value.npos;
            word = option + (folder ? map(value) : map_shader(value));
        }
    }
}

fs::path folder_of(const std::string& file) {
    return fs::absolute(file).lexically_normal().parent_path();
}

// Relative where both lie in one tree below the root: it can be moved as a whole.
std::string from_folder(const fs::path& folder, const std::string& path) {
    fs::path whole = fs::absolute(path).lexically_normal();
    auto first_folder = [](const fs::path& p) { return *p.relative_path().begin(); };
    bool apart = folder == folder.root_path() || first_folder(whole) != first_folder(folder);
    return apart ? whole.string() : whole.lexically_relative(folder).string();
}

std::string to_working_folder(const fs::path& folder, const std::string& path) {
    fs::path whole = (folder / path).lexically_normal();  // an absolute path stays
    std::error_code code;
    fs::path near = fs::proximate(whole, code);
    return code || near.string().starts_with("..") ? whole.string() : near.string();
}

Json json_of(dvec3 v) {
    return {v.x, v.y, v.z};
}

Json json_of(const SessionCamera& camera) {
    Json json{{"index", camera.index}, {"name", camera.name}};
    if (const auto& own = camera.own)
        json["own"] = {{"pivot", json_of(own->pivot)},
                       {"distance", own->distance},
                       {"right", json_of(own->axes[0])},
                       {"up", json_of(own->axes[1])},
                       {"back", json_of(own->axes[2])},
                       {"parallel", own->parallel},
                       {"half_height", own->half_height},
                       {"near", own->znear},
                       {"far", own->zfar}};
    if (const auto& follow = camera.follow)
        json["follow"] = {{"node", follow->first}, {"from", json_of(follow->second)}};
    return json;
}

Json json_of(const SceneEdits& edits) {
    Json json{{"shaders", edits.shaders}, {"params", edits.params}, {"hidden", edits.hidden}};
    Json& texts = json["texts"] = Json::array();
    for (const SceneEdits::Text& text : edits.texts)
        texts.push_back({{"material", text.material},
                         {"file", text.file},
                         {"text", text.text},
                         {"alone", text.alone}});
    return json;
}

constexpr std::string_view kPngUrl = "data:image/png;base64,";  // RFC 2397

Json json_of(const KeptPicture& kept) {
    return {{"frame", kept.frame},
            {"picture", std::string(kPngUrl) + base64(encode_png(kept.image))}};
}

// Members with their places, for messages: "camera.own.distance".
class Reader {
  public:
    Reader(const Json& json, std::string place) : json_(json), place_(std::move(place)) {}

    bool has(const char* name) const { return json_.contains(name); }
    Reader member(const char* name) const {
        if (!json_.is_object()) fail("is no object");
        std::string place = place_.empty() ? name : place_ + "." + name;
        if (!has(name)) throw std::runtime_error(place + " is missing");
        return {json_[name], place};
    }
    template <class T>
    T as(const char* what) const {
        try {
            return json_.get<T>();
        } catch (const nlohmann::json::exception&) {
            fail(fmt::format("is no {}", what));
        }
    }
    double number(double low = -1e300, double high = 1e300) const {
        if (!json_.is_number()) fail("is no number");
        double value = json_.get<double>();
        if (!(value >= low && value <= high))
            fail(fmt::format("is {}, not {} to {}", value, low, high));
        return value;
    }
    std::string text() const { return as<std::string>("text"); }
    std::vector<std::string> texts() const { return as<std::vector<std::string>>("list of texts"); }
    std::vector<std::pair<std::string, std::string>> pairs() const {
        return as<std::vector<std::pair<std::string, std::string>>>("list of pairs of texts");
    }
    dvec3 triple() const {
        if (!json_.is_array() || json_.size() != 3) fail("is no list of three numbers");
        dvec3 v;
        for (int k = 0; k < 3; ++k) v[k] = Reader(json_[size_t(k)], place_).number();
        return v;
    }
    std::vector<Reader> list() const {
        if (!json_.is_array()) fail("is no list");
        std::vector<Reader> readers;
        for (size_t k = 0; k < json_.size(); ++k)
            readers.emplace_back(json_[k], fmt::format("{}[{}]", place_, k));
        return readers;
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw std::runtime_error((place_.empty() ? "the file" : place_) + " " + why);
    }

  private:
    const Json& json_;
    std::string place_;
};

FreeCamera free_camera(const Reader& json) {
    FreeCamera own;
    own.pivot = json.member("pivot").triple();
    own.distance = json.member("distance").number(1e-12, 1e18);
    own.axes = {json.member("right").triple(), json.member("up").triple(),
                json.member("back").triple()};
    own.parallel = json.member("parallel").as<bool>("true or false");
    own.half_height = json.member("half_height").number(1e-12, 1e18);
    own.znear = json.member("near").number();
    own.zfar = json.member("far").number();
    return own;
}

SessionCamera session_camera(const Reader& json) {
    SessionCamera camera;
    camera.index = uint32_t(json.member("index").number(0, 1e9));
    camera.name = json.member("name").text();
    if (json.has("own")) camera.own = free_camera(json.member("own"));
    if (json.has("follow")) {
        Reader follow = json.member("follow");
        camera.follow = {follow.member("node").text(), follow.member("from").triple()};
    }
    return camera;
}

SceneEdits edits_of(const Reader& json) {
    SceneEdits edits;
    edits.shaders = json.member("shaders").pairs();
    edits.params = json.member("params").pairs();
    edits.hidden = json.member("hidden").texts();
    for (const Reader& text : json.member("texts").list())
        edits.texts.push_back(
            {text.member("material").text(), text.member("file").text(), text.member("text").text(),
             0, text.has("alone") && text.member("alone").as<bool>("true or false")});
    return edits;
}

KeptPicture kept_picture(const Reader& json) {
    KeptPicture kept;
    kept.frame = json.member("frame").number(-1e12, 1e12);
    const Reader picture = json.member("picture");
    const std::string text = picture.text();
    std::optional<Image8> image;
    if (text.starts_with(kPngUrl))
        if (auto bytes = from_base64(std::string_view(text).substr(kPngUrl.size())))
            image = decode_png(*bytes);
    if (!image) picture.fail(fmt::format("is no PNG behind '{}'", kPngUrl));
    kept.image = std::move(*image);
    return kept;
}

Session session_of(const Reader& json) {
    if (int version = int(json.member(kVersionName).number(0, 1e6)); version != kVersion)
        throw std::runtime_error(
            fmt::format("{} is {}; this Kinora reads {}", kVersionName, version, kVersion));
    Session session;
    session.scene = json.member("scene").text();
    session.options = json.member("options").texts();
    session.frame = json.member("frame").number(-1e12, 1e12);
    session.width = int(json.member("width").number(1, kMostPixels));
    session.height = int(json.member("height").number(1, kMostPixels));
    session.exposure = json.member("exposure").number(-1000, 1000);
    session.camera = session_camera(json.member("camera"));
    session.edits = edits_of(json.member("edits"));
    session.panels = json.member("panels").texts();
    session.commands = json.member("commands").texts();
    if (json.has("kept")) session.kept = kept_picture(json.member("kept"));
    return session;
}

// "3:7" of a byte of the text.
std::string line_column(const std::string& text, size_t byte) {
    size_t at = std::min(byte > 0 ? byte - 1 : 0, text.size());
    long line = 1 + std::count(text.begin(), text.begin() + ptrdiff_t(at), '\n');
    size_t newline = at > 0 ? text.rfind('\n', at - 1) : text.npos;
    return fmt::format("{}:{}", line, newline == text.npos ? at + 1 : at - newline);
}

}  // namespace

std::string session_text(const Session& session) {
    Json json{{kVersionName, kVersion},          {"scene", session.scene},
              {"options", session.options},      {"frame", session.frame},
              {"width", session.width},          {"height", session.height},
              {"exposure", session.exposure},    {"camera", json_of(session.camera)},
              {"edits", json_of(session.edits)}, {"panels", session.panels},
              {"commands", session.commands}};
    if (session.kept) json["kept"] = json_of(*session.kept);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string write_session(const std::string& file, const Session& session) {
    Session stored = session;
    fs::path folder = folder_of(file);
    map_paths(stored, [&](const std::string& path) { return from_folder(folder, path); });
    const int number = write_whole_file(file, session_text(stored));
    return number ? std::strerror(number) : "";
}

std::optional<Session> read_session(const std::string& file, std::string& error) {
    std::ifstream in(file, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    if (!in) {
        error = fmt::format("'{}': {}", file, std::strerror(errno));
        return std::nullopt;
    }
    try {
        Session session = session_of({Json::parse(text), ""});
        fs::path folder = folder_of(file);
        map_paths(session,
                  [&](const std::string& path) { return to_working_folder(folder, path); });
        return session;
    } catch (const nlohmann::json::parse_error& bad) {
        error = fmt::format("{}:{}: this is no JSON, which a session is", file,
                            line_column(text, bad.byte));
    } catch (const std::exception& bad) {
        error = fmt::format("'{}' is no session: {}", file, bad.what());
    }
    return std::nullopt;
}

}  // namespace kinora
