// rsl/text/preprocess.cpp: the reading of the source: text lines pass through, macros expand, '#'
// lines are directives.
#include "rsl/text/preprocess.h"

#include <fmt/format.h>

#include <cctype>
#include <utility>

#include "rsl/text/lexer.h"

namespace kinora::rsl {

namespace {

// A word anywhere in a source, and the header that defines what it says. The struct's name has
// misprints, which end as it does.
constexpr std::pair<std::string_view, std::string_view> kHeadersByWord[] = {
    {"_radiancesample", "stdrsl/RadianceSample.h"},
    {"__radiositysample", "stdrsl/RadianceSample.h"},
    {"filterregion", "filterregion.h"},
    {"directlighting", "integrators.h"},
    {"indirectspecular", "integrators.h"},
    {"evaluateSamples", "lightsamples.h"},
    {"getlights", "getlights.h"},
};

// Functions, and the header that has them.
constexpr std::pair<std::string_view, std::string_view> kHeadersByCall[] = {
    {"erf", "prman.h"},
    {"erfc", "prman.h"},
    {"gridnever", "prman.h"},
    {"randomstrat", "prman.h"},
    {"wnoise", "prman.h"},
    {"generateSamplesAS", "prman_samples.h"},
    {"evaluateSamplesAS", "prman_samples.h"},
    {"generateSamplesEnv", "prman_samples.h"},
    {"evaluateSamplesEnv", "prman_samples.h"},
};

// Whether "name(" stands in the text.
bool calls(std::string_view text, std::string_view name) {
    auto in_word = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)); };
    for (size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
        size_t end = text.find_first_not_of(" \t", at + name.size());
        if (end != text.npos && text[end] == '(' && (at == 0 || !in_word(text[at - 1])))
            return true;
    }
    return false;
}

}  // namespace

Preprocessor::Preprocessor(const CompileOptions& options, Diagnostics& diagnostics,
                           TokenStream& out, Reporter& reporter)
    : options_(options),
      source_files_(diagnostics.files),
      out_(out),
      reporter_(reporter),
      texts_(out),
      files_(reporter),
      budget_(out, reporter),
      includes_(options, diagnostics.files, texts_, reporter),
      expander_(macros_, files_, texts_, budget_, out, source_files_, reporter,
                [&directives = directives_] { directives.obey(); }),
      directives_(macros_, files_, expander_, includes_, budget_, out, reporter) {
    if (out_.macros.empty()) out_.macros.push_back({});
}

// As "#define NAME VALUE", where NAME may have parameters.
void Preprocessor::define(std::string_view name, std::string_view value) {
    TokenList line = texts_.tokens_of(fmt::format("{} {}", name, value));
    Token directive;
    directive.text = "define";
    if (auto macro = read_macro(directive, line, reporter_)) macros_.define(std::move(*macro));
}

void Preprocessor::define_from_options() {
    for (const char* name : {"__FILE__", "__LINE__"}) {
        Macro macro;
        macro.name = name;
        macro.special = true;
        macros_.define(std::move(macro));
    }
    define("KINORA", "1");
    // What C gives where it does not know the time: the same source gives the same code.
    define("__DATE__", "\"??? ?? ????\"");
    define("__TIME__", "\"??:??:??\"");
    for (const auto& [name, value] : options_.defines) define(name, value);
    for (const std::string& name : options_.undefines) macros_.undefine(name);
}

void Preprocessor::run(const ShaderSource& source) {
    define_from_options();
    std::string path;
    if (source.map.file != kNoFile) path = source_files_.name(source.map.file);
    files_.enter({texts_.keep(std::string(source.text)), &texts_.keep(source.map), path});
    // What is known without its header, as if the source began with that.
    auto begin_with = [&](std::string_view name) {
        if (auto header = includes_.find(std::string(name), false, "", Token()))
            files_.enter(*header);
    };
    for (const auto& [word, name] : kHeadersByWord)
        if (source.text.find(word) != source.text.npos) begin_with(name);
    for (const auto& [name, header] : kHeadersByCall)
        if (calls(source.text, name)) begin_with(header);
    out_.tokens.reserve(source.text.size() / 4 + 16);
    read();
}

void Preprocessor::emit(Token token) {
    if (token.text == "_radiancesample" || token.text == "__radiositysample") {
        if (misprints_.insert(token.text).second)
            reporter_.report(Code::RSL_MISPRINTED_TYPE, token, token.text);
        token.text = "__radiancesample";
    }
    if (token.kind == TokenKind::Identifier) token.word = find_word(token.text);
    out_.tokens.push_back(token);
}

// "x = 1; # as it was": some shaders have remarks of this kind.
bool Preprocessor::begins_remark(const Token& token) {
    bool hash = token.punct == Punct::Hash && !token.line_start && token.macro == 0;
    if (!hash || out_.tokens.empty() || files_.skipping()) return false;
    Punct last = out_.tokens.back().punct;
    if (last != Punct::Semicolon && last != Punct::RightBrace) return false;
    reporter_.report(Code::RSL_HASH_REMARK, token);
    return true;
}

void Preprocessor::read() {
    Token token;
    bool remark = false;  // behind a '#' within a line
    while (true) {
        token = expander_.next();
        if (budget_.exhausted() || reporter_.full()) break;
        remark = remark && !token.line_start && token.kind != TokenKind::End;
        if (remark) continue;
        remark = begins_remark(token);
        if (remark) continue;
        if (token.kind != TokenKind::End) {
            if (token.punct == Punct::Hash && token.line_start && token.macro == 0)
                directives_.obey();
            else if (!files_.skipping())
                emit(token);
            continue;
        }
        if (files_.depth() == 1) break;
        files_.leave();
    }
    while (files_.depth() > 0) {
        if (files_.depth() == 1) token = files_.next();
        files_.leave();
    }
    Token end;
    end.where = end.spelling = token.where;
    end.line_start = true;
    out_.tokens.push_back(end);
}

}  // namespace kinora::rsl
