// runtime/programs/render/session_words.cpp: options as words: what a session keeps, and what it
// gives.
#include "runtime/programs/render/session_words.h"

#include "runtime/base/file_extension.h"

namespace kinora {

namespace {

constexpr std::string_view kRepeatable[] = {"--shader", "--param", "--hide",
                                            "--only",   "--aov",   "--allow-external"};

bool gives(const std::vector<std::string>& words, std::string_view option) {
    return std::ranges::any_of(words, [&](const std::string& word) {
        return word.starts_with(option) &&
               (word.size() == option.size() || word[option.size()] == '=');
    });
}

// The session's words, but for those that the command line gives too. What may be given several
// times adds up.
std::vector<std::string> with_session(const Session& session,
                                      const std::vector<std::string>& given) {
    std::vector<std::string> words;
    for (const std::string& word : session.options) {
        std::string_view option = std::string_view(word).substr(0, word.find('='));
        bool adds_up = std::ranges::find(kRepeatable, option) != std::end(kRepeatable);
        if (option.starts_with("--") && (adds_up || !gives(given, option))) words.push_back(word);
        if (!option.starts_with("--") && option.starts_with("-I")) words.push_back(word);
    }
    words.insert(words.end(), given.begin(), given.end());
    return words;
}

// The command line is stronger than what the player was set to.
void override_session(const std::vector<std::string>& given, Session& session) {
    if (gives(given, "--size") || gives(given, "--scale")) session.width = session.height = 0;
    if (gives(given, "--exposure")) session.exposure = 0;
    for (const char* option : {"--camera", "--look-from", "--look-at", "--turntable"})
        if (gives(given, option)) session.camera = {};
}

bool is_session(const std::string& word) {
    return has_extension(word, {".kinora"}) && !word.starts_with("-");
}

// The file of `--session FILE`, or a word that ends so, which is taken out; "" none.
std::string take_session(std::vector<std::string>& words) {
    for (size_t i = 0; i < words.size(); ++i) {
        constexpr std::string_view kOption = "--session";
        if (words[i] == kOption && i + 1 < words.size()) return words[i + 1];
        if (words[i].starts_with("--session=")) return words[i].substr(kOption.size() + 1);
    }
    auto found = std::ranges::find_if(words, is_session);
    if (found == words.end()) return "";
    std::string file = *found;
    words.erase(found);
    return file;
}

}  // namespace

std::vector<std::string> given_words(const std::vector<const CLI::Option*>& options) {
    std::vector<std::string> words;
    for (const CLI::Option* option : options) {
        const std::string name = option->get_name();
        const bool flag = option->get_items_expected_max() == 0;
        if (flag && option->count() > 0) words.push_back(name);
        if (flag) continue;
        for (const std::string& value : option->results())
            words.push_back(name + (name.starts_with("--") ? "=" : "") + value);
    }
    return words;
}

std::string read_session_of(std::vector<std::string>& words, RenderOptions& o) {
    std::string error, file = take_session(words);
    if (file.empty()) return "";
    o.session = read_session(file, error);
    if (!o.session) return error;
    override_session(words, *o.session);
    words = with_session(*o.session, words);
    return "";
}

}  // namespace kinora
