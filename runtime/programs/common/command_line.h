// runtime/programs/common/command_line.h: what the programs' command lines have in common. It sees
// CLI11, which is slow to compile: for the one file of each program that reads its options.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/base/tasks/usable_cores.h"
#include "runtime/programs/common/exit_codes.h"

namespace kinora {

inline constexpr int kMostThreads = 1024;

// "8", "-1" (all but one) or "all": the cores that the process may use.
inline int parse_threads(const std::string& text, const char* option = "--threads") {
    const int cores = usable_cores();
    if (text == "all") return cores;
    int n = 0;
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (error != std::errc() || *end != 0 || n == 0)
        throw CLI::ValidationError(option, "takes a number, -N (all but N) or 'all'");
    if (n > kMostThreads)
        throw CLI::ValidationError(option, fmt::format("takes {} at most", kMostThreads));
    return n > 0 ? n : std::max(1, cores + n);
}

// "NAME=VALUE" in two, neither empty; `takes` says what the option takes.
inline std::pair<std::string, std::string> split_pair(const std::string& text, const char* option,
                                                      const char* takes) {
    size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw CLI::ValidationError(option, fmt::format("takes {}, not '{}'", takes, text));
    return {text.substr(0, equals), text.substr(equals + 1)};
}

// "'W' is none of X, Y, Z".
inline std::string none_of(const std::string& text, const std::vector<std::string_view>& names) {
    std::string_view near = nearest_name(text, names);
    return fmt::format("'{}' is none of {}{}", text, fmt::join(names, ", "),
                       near.empty() ? "" : fmt::format("; did you mean {}?", near));
}

// A value by its name, whatever its case.
template <class T>
struct Choice {
    const char* name;
    T value;
};
template <class T, class Out>
CLI::Option* add_choice(CLI::App& app, const std::string& option, Out& out,
                        std::vector<Choice<T>> rows, const std::string& help) {
    auto take = [&out, rows = std::move(rows), option](const std::string& text) {
        std::vector<std::string_view> names;
        for (const Choice<T>& row : rows) {
            names.push_back(row.name);
            if (CLI::detail::to_lower(text) != CLI::detail::to_lower(row.name)) continue;
            out = row.value;
            return;
        }
        throw CLI::ValidationError(option, none_of(text, names));
    };
    return app.add_option_function<std::string>(option, take, help)->type_name("NAME");
}

// One of these texts.
inline CLI::Validator one_of(std::vector<std::string_view> names) {
    return {[names](std::string& text) {
                bool known = std::find(names.begin(), names.end(), text) != names.end();
                return known ? std::string() : none_of(text, names);
            },
            ""};
}

// --fail-on, of programs that make something of a scene.
inline void add_fail_on(CLI::App& app, Severity& fail_on) {
    add_choice<Severity>(app, "--fail-on", fail_on,
                         {{"warning", Severity::Warning}, {"error", Severity::Error}},
                         "exit 1 after findings of this severity: warning or error (error)");
}

// An option that may be repeated. It takes one word a time: what follows may be the scene.
// `delimiter` parts the word into several.
inline CLI::Option* add_list(CLI::App& app, const std::string& names, std::vector<std::string>& out,
                             const std::string& help, char delimiter = '\0') {
    CLI::Option* option = app.add_option(names, out, help)->type_name("TEXT");
    if (delimiter != '\0') option->delimiter(delimiter);
    return option->allow_extra_args(false);
}

// An option whose value may be left out, and what it then is. The next word is its value only if it
// is no file and no option: `--stats scene.dae` names a scene.
struct OptionalValue {
    std::string_view option, otherwise;
};

// `--stats` as `--stats=text`.
inline std::vector<std::string> with_values(std::vector<std::string> words,
                                            const std::vector<OptionalValue>& rows) {
    for (size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
        auto row = std::find_if(rows.begin(), rows.end(),
                                [&](const OptionalValue& r) { return r.option == words[i]; });
        if (row == rows.end()) continue;
        bool given = i + 1 < words.size() && words[i + 1].find_first_of("./-") == std::string::npos;
        words[i] += fmt::format("={}", given ? std::string_view(words[i + 1]) : row->otherwise);
        if (given) words.erase(words.begin() + ptrdiff_t(i) + 1);
    }
    return words;
}

// What was not understood, and what may have been meant.
inline std::string unexpected_word(const CLI::App& app) {
    std::vector<std::string> rest = app.remaining(true);
    auto found = std::find_if(rest.begin(), rest.end(),
                              [](const std::string& word) { return word.starts_with("-"); });
    if (found == rest.end())
        return fmt::format("'{}' is one word too many", rest.empty() ? "" : rest.front());
    std::string word = found->substr(0, found->find('='));
    std::vector<std::string> names;
    auto add = [&](const CLI::App& of) {
        for (const CLI::Option* option : of.get_options())
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    };
    add(app);
    for (const CLI::App* command : app.get_subcommands()) add(*command);
    std::string_view near = nearest_name(word, {names.begin(), names.end()});
    return fmt::format("there is no option {}{}", word,
                       near.empty() ? "" : fmt::format("; did you mean {}?", near));
}

// `--size --spp 4`: no value of an option is the name of another.
inline void refuse_options_as_values(const CLI::App& app, const std::vector<std::string>& words) {
    for (size_t i = 0; i + 1 < words.size() && words[i] != "--"; ++i) {
        const CLI::Option* option = app.get_option_no_throw(words[i]);
        bool takes_value = option && words[i].starts_with("-") && option->get_items_expected_min();
        if (takes_value && words[i + 1].starts_with("--") && app.get_option_no_throw(words[i + 1]))
            throw CLI::ValidationError(
                words[i], fmt::format("needs a value; '{}' is an option", words[i + 1]));
    }
}

inline std::string usage_text(const CLI::App& app, const CLI::ParseError& error) {
    std::string text = error.what();
    constexpr std::string_view kUnconverted = "Could not convert: ";  // "... --unit = inch"
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        text = unexpected_word(app);
    } else if (text == "A subcommand is required") {
        std::vector<std::string> names;
        for (const CLI::App* command : app.get_subcommands({}))
            names.push_back(command->get_name());
        text = fmt::format("needs a command: {}", fmt::join(names, ", "));
    } else if (size_t equals = text.find(" = ");
               text.starts_with(kUnconverted) && equals != std::string::npos) {
        text = fmt::format("{}: '{}' is no number",
                           text.substr(kUnconverted.size(), equals - kUnconverted.size()),
                           text.substr(equals + 3));
    }
    return fmt::format("{0}: {1}\n{0} --help lists all options.\n", app.get_name(), text);
}

// Reads the words of the command line (those behind the program's name) and calls `interpret`,
// which throws CLI's errors for what makes no sense, as `before` does of the bare words. Gives the
// exit code of --help, --version and usage errors, which are printed; nothing when there is work to
// do.
inline std::optional<int> parse_command_line(CLI::App& app, std::vector<std::string> words,
                                             const std::vector<OptionalValue>& optional,
                                             const std::function<void()>& interpret,
                                             const std::function<void()>& before = nullptr) {
    app.failure_message([](const CLI::App* of, const CLI::Error& error) {
        return usage_text(*of, static_cast<const CLI::ParseError&>(error));
    });
    try {
        if (before) before();
        words = with_values(std::move(words), optional);
        refuse_options_as_values(app, words);
        std::reverse(words.begin(), words.end());
        app.parse(std::move(words));
        interpret();
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        int code = app.exit(error);
        return code == 0 ? kExitOk : kExitUsage;
    }
}

inline std::vector<std::string> words_of(int argc, char** argv) {
    return {argv + std::min(argc, 1), argv + argc};
}

}  // namespace kinora
