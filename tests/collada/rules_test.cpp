// tests/collada/rules_test.cpp: each code with a file that must cause it and one that must not.
//
// CODE.dae holds <!-- expect: CODE --> at the end of each line where a finding begins, or alone on
// the line before it; CODE.ok.dae must not cause CODE at all. A second file of either kind has more
// between the dots: CODE.morph.dae, CODE.ok.morph.dae. rules/README.md says how they are written.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "collada/document/findings.h"
#include "collada/document/open_scene.h"
#include "collada/validate/validate.h"
#include "tests/collada/reading.h"
#include "tests/collada/scene_promises.h"
#include "tests/folders.h"
#include "tests/mutate.h"

namespace kinora::collada {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(test_data_folder()) / "rules";

struct RuleFile {
    std::string name, code;
    bool ok = false;  // must not cause it
};
void PrintTo(const RuleFile& file, std::ostream* out) {
    *out << file.name;
}

std::vector<RuleFile> rule_files() {
    std::vector<RuleFile> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(kFolder)) {
        std::string extension = entry.path().extension().string();
        if (extension != ".dae" && extension != ".zae" && extension != ".kmz") continue;
        std::string name = entry.path().filename().string();
        std::string code = name.substr(0, name.find('.'));
        std::string rest = name.substr(code.size());
        files.push_back({name, code, rest.starts_with(".ok.")});
    }
    std::sort(files.begin(), files.end(), [](auto& a, auto& b) { return a.name < b.name; });
    return files;
}

using Mark = std::pair<int, std::string>;  // line, code

std::vector<Mark> read_marks(const fs::path& path) {
    std::vector<Mark> marks;
    std::ifstream in(path);
    std::string line;
    const std::string open = "<!-- expect: ";
    for (int number = 1; std::getline(in, line); ++number) {
        size_t at = line.find(open);
        bool alone = at != line.npos && line.find_first_not_of(" \t") == at;
        for (; at != line.npos; at = line.find(open, at + 1)) {
            size_t begin = at + open.size();
            marks.push_back({number + alone, line.substr(begin, line.find(' ', begin) - begin)});
        }
    }
    return marks;
}

// Codes that are off by default are on here.
void validate_file(Reading& r, const std::string& name, const std::string& code) {
    for (const FindingInfo* const* info = all_findings(); *info; ++info)
        if ((*info)->code == code && (*info)->severity == Severity::Off)
            r.diag.set_severity(code, Severity::Hint);
    std::optional<SceneFile> file = open_scene((kFolder / name).string(), r.diag);
    if (!file) return;
    ValidateOptions options;
    options.extract.folder = file->folder;
    options.extract.models = file->models;
    r.document = read_document(file->document, r.diag);
    if (r.document) r.scene = validate(*r.document, r.diag, options);
}

std::set<Mark> found_marks(const Reading& r) {
    std::set<Mark> found;
    for (const Finding& f : r.diag.findings())
        if (f.where.file == 0)
            found.insert({r.diag.files.line_column(0, f.where.begin).line, f.info->code});
    return found;
}

// Files that cannot hold a mark: the finding may be anywhere.
const std::set<std::string> kUnmarked = {"XML_EMPTY",        "XML_ENCODING",  "XML_RECODED",
                                         "ARCHIVE_OPEN",     "ARCHIVE_LIMIT", "ARCHIVE_MEMBER",
                                         "ARCHIVE_NO_SCENE", "ARCHIVE_ROOT",  "ARCHIVE_NESTED",
                                         "ARCHIVE_MODEL",    "ARCHIVE_PLACE"};

class Rules : public testing::TestWithParam<RuleFile> {};

TEST_P(Rules, FileSaysWhatIsFound) {
    const RuleFile& file = GetParam();
    Reading r;
    validate_file(r, file.name, file.code);
    if (file.ok) {
        EXPECT_EQ(r.count(file.code), 0u) << r.all();
        return;
    }
    EXPECT_GE(r.count(file.code), 1u) << r.all();
    std::vector<Mark> marks = read_marks(kFolder / file.name);
    bool marked = false;
    for (const Mark& mark : marks) marked = marked || mark.second == file.code;
    EXPECT_TRUE(marked || kUnmarked.count(file.code)) << "no mark <!-- expect: " << file.code;
    std::set<Mark> found = found_marks(r);
    for (const Mark& mark : marks)
        EXPECT_TRUE(found.count(mark))
            << mark.second << " is not reported at line " << mark.first << "\n"
            << r.all();
    // The code of the file is found at its marks only.
    std::set<Mark> wanted(marks.begin(), marks.end());
    for (const Mark& at : found)
        EXPECT_TRUE(!marked || at.second != file.code || wanted.count(at))
            << "unexpected at line " << at.first << "\n"
            << r.all();
}

INSTANTIATE_TEST_SUITE_P(Folder, Rules, testing::ValuesIn(rule_files()), [](const auto& test) {
    std::string name = test.param.name.substr(0, test.param.name.rfind('.'));
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
    return name;
});

// Codes without a pair, and why.
const std::set<std::string> kNoPair = {
    "XML_OPEN",    // there is no file to hold
    "XML_LIMIT",   // takes a file beyond 2 GB
    "SCENE_NONE",  // the validator says SCENE_MISSING
};

TEST(RuleFiles, EveryCodeHasAFileThatCausesItAndOneThatDoesNot) {
    std::set<std::string> bad, ok;
    for (const RuleFile& file : rule_files()) (file.ok ? ok : bad).insert(file.code);
    std::string missing;
    for (const FindingInfo* const* info = all_findings(); *info; ++info) {
        std::string code = (*info)->code;
        if (kNoPair.count(code)) continue;
        if (!bad.count(code)) missing += code + ".dae ";
        if (!ok.count(code)) missing += code + ".ok.dae ";
    }
    EXPECT_EQ(missing, "");
}

TEST(RuleFiles, EveryFileIsOfACode) {
    std::set<std::string> codes;
    for (const FindingInfo* const* info = all_findings(); *info; ++info)
        codes.insert((*info)->code);
    for (const RuleFile& file : rule_files()) EXPECT_TRUE(codes.count(file.code)) << file.name;
}

// No finding is doubled, and a validation is the same each time.
TEST(RuleFiles, ValidatingTwiceSaysTheSame) {
    for (const RuleFile& file : rule_files()) {
        Reading first, second;
        validate_file(first, file.name, file.code);
        validate_file(second, file.name, file.code);
        EXPECT_EQ(first.all(), second.all()) << file.name;
    }
}

// Words that rules look at, put anywhere.
const std::vector<std::string> kWords = {"#scene",
                                         "#quad",
                                         "#fx",
                                         "#img",
                                         "#pos",
                                         "source=\"#pos\"",
                                         "url=\"#quad\"",
                                         "0",
                                         "-1",
                                         "NaN",
                                         "<p>0 1 2</p>",
                                         "<ph>",
                                         "</p>",
                                         "4294967295",
                                         "1.4.1",
                                         "1.5.0",
                                         "<technique profile=\"RSL\">",
                                         "<skin source=\"#skin\">",
                                         "<newparam sid=\"surface\">",
                                         "sampler",
                                         "material=\"paint\""};

TEST(RuleFiles, DamagedEndInFindings) {
    std::vector<std::string> corpus;
    for (const RuleFile& file : rule_files()) {
        std::ifstream in(kFolder / file.name, std::ios::binary);
        corpus.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    Mutator mutator(corpus, kWords, 29);
    for (int i = 0; i < 4000; ++i) {
        Reading r;
        r.document = read_document_text((kFolder / "mutant.dae").string(), mutator.next(), r.diag);
        if (!r.document) continue;
        r.scene = validate(*r.document, r.diag);
        std::string broken = r.scene ? broken_promise(*r.scene) : std::string();
        ASSERT_EQ(broken, "");
        ASSERT_EQ(broken_place(r.diag), "");
    }
}

}  // namespace
}  // namespace kinora::collada
