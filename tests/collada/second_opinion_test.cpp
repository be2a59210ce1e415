// tests/collada/second_opinion_test.cpp: what Debian's DAEValidator says of links, ids and sids, we
// say at the same line.
#include <gtest/gtest.h>

#include <cstdio>
#include <set>

#include "collada/validate/validate.h"
#include "tests/collada/reading.h"
#include "tests/folders.h"
#include "tests/shared.h"

namespace kinora::collada {
namespace {

namespace fs = std::filesystem;

const char* const kValidator = "/usr/lib/opencollada/DAEValidator";

struct Complaint {
    int line = 0;
    std::string text;
};

// Lines like "file:///scene.dae:12: Can't resolve #nothing".
std::vector<Complaint> complaints(const fs::path& path) {
    std::string command = std::string("cd /tmp && ") + kValidator + " '" + path.string() +
                          "' --check-links --check-unique-ids --check-unique-sids 2>&1";
    std::vector<Complaint> list;
    FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return list;
    char buffer[4096];
    while (std::fgets(buffer, sizeof buffer, pipe)) {
        std::string row = buffer;
        size_t at = row.find(": Can't resolve ");
        if (at == row.npos) at = row.find(": Duplicated ");
        size_t colon = at == row.npos ? row.npos : row.rfind(':', at - 1);
        if (colon == row.npos) continue;
        list.push_back({std::atoi(row.c_str() + colon + 1), row.substr(at + 2)});
    }
    pclose(pipe);
    return list;
}

// 1.5 gives an image's file in <init_from><ref>; it takes the white space around <ref> for a URI.
bool is_its_mistake(const std::string& text) {
    std::string line = text.substr(0, text.find_last_not_of(" \r\n") + 1);
    return line.ends_with('/');
}

void expect_all_seen(const fs::path& path, size_t& count) {
    std::vector<Complaint> theirs = complaints(path);
    if (theirs.empty()) return;
    Reading r;
    r.document = read_document(path.string(), r.diag);
    if (r.document) r.scene = validate(*r.document, r.diag);
    std::set<int> lines;
    const char* const groups[] = {"LINK_", "FILE_", "ID_", "SID_", "SRC_", "RSL_INCLUDE_"};
    for (const Finding& f : r.diag.findings()) {
        if (f.where.file != 0) continue;
        int line = r.diag.files.line_column(0, f.where.begin).line;
        std::string_view code = f.info->code;
        for (const char* group : groups)
            if (code.starts_with(group)) lines.insert(line);
        // Reported at the <source> whose array's ids these are, one line up in our files.
        if (code == "MORPH_TARGET_MISSING") lines.insert(line + 1);
    }
    for (const Complaint& c : theirs) {
        count += !is_its_mistake(c.text);
        EXPECT_TRUE(is_its_mistake(c.text) || lines.count(c.line))
            << path << ":" << c.line << ": " << c.text;
    }
}

TEST(SecondOpinion, DaeValidatorSeesNoLinkOrIdThatWeDoNot) {
    if (!fs::exists(kValidator)) GTEST_SKIP() << "opencollada-tools are not installed";
    size_t count = 0;
    for (const fs::path& folder : {fs::path(test_data_folder()) / "rules", shared_scenes()}) {
        if (!fs::exists(folder)) continue;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
            std::string extension = entry.path().extension().string();
            bool scene = extension == ".dae" || extension == ".DAE";
            if (scene && entry.file_size() > 0) expect_all_seen(entry.path(), count);
        }
    }
    EXPECT_GT(count, 40u);  // it did look
}

}  // namespace
}  // namespace kinora::collada
