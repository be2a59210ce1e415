// tests/collada/robustness_test.cpp: cut and flipped files end in findings, never in a crash.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

#include "tests/collada/reading.h"
#include "tests/collada/scene_promises.h"

namespace kinora::collada {
namespace {

std::string bytes_of(const std::string& name) {
    std::ifstream in(test_file(name), std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

void read_and_check(std::string bytes) {
    Reading r;
    read_text(r, std::move(bytes), test_file("mutant.dae"));
    if (r.scene) {
        ASSERT_EQ(broken_promise(*r.scene), "");
    } else {
        EXPECT_TRUE(r.diag.has_errors());
    }
    ASSERT_EQ(broken_place(r.diag), "");
}

const char* const kFiles[] = {"matte.dae", "skinned.dae", "common.dae"};

TEST(Robustness, EveryTruncation) {
    for (const char* name : kFiles) {
        std::string bytes = bytes_of(name);
        ASSERT_FALSE(bytes.empty());
        for (size_t length = 0; length < bytes.size(); ++length)
            read_and_check(bytes.substr(0, length));
    }
}

TEST(Robustness, RandomBitFlips) {
    std::mt19937 random(11);
    for (const char* name : kFiles) {
        const std::string bytes = bytes_of(name);
        for (int i = 0; i < 2000; ++i) {
            std::string mutant = bytes;
            for (uint32_t flips = 1 + random() % 3; flips > 0; --flips)
                mutant[random() % mutant.size()] ^= char(1 << random() % 8);
            read_and_check(std::move(mutant));
        }
    }
}

// Bit flips mostly break the XML; these keep it and change what it says.
TEST(Robustness, RandomNumbersAndLinks) {
    std::mt19937 random(13);
    const char* const words[] = {"0", "-1", "4000000000", "NaN", "", "9", "1e999", "#base", "#pos"};
    for (const char* name : kFiles) {
        const std::string bytes = bytes_of(name);
        for (int i = 0; i < 3000; ++i) {
            std::string mutant = bytes;
            size_t at = random() % mutant.size();
            bool attribute = random() % 2;
            size_t begin = mutant.find(attribute ? "=\"" : ">", at);
            if (begin == std::string::npos) continue;
            begin += attribute ? 2 : 1;
            size_t end = mutant.find(attribute ? '"' : '<', begin);
            if (end == std::string::npos) continue;
            mutant.replace(begin, end - begin, words[random() % std::size(words)]);
            read_and_check(std::move(mutant));
        }
    }
}

// Whole elements gone or doubled.
TEST(Robustness, RandomElementsRemovedOrDoubled) {
    std::mt19937 random(17);
    for (const char* name : kFiles) {
        const std::string bytes = bytes_of(name);
        Diagnostics diag;
        std::optional<Document> document = read_document_text(name, bytes, diag);
        ASSERT_TRUE(document);
        std::vector<ByteRange> ranges;
        std::vector<const Element*> todo{document->root().first_child};
        while (!todo.empty()) {
            const Element* e = todo.back();
            todo.pop_back();
            ranges.push_back(e->bytes);
            if (e->next) todo.push_back(e->next);
            if (e->first_child) todo.push_back(e->first_child);
        }
        for (const ByteRange& range : ranges) {
            std::string removed = bytes, doubled = bytes;
            removed.erase(range.begin, range.end - range.begin);
            doubled.insert(range.begin, bytes.substr(range.begin, range.end - range.begin));
            read_and_check(std::move(removed));
            read_and_check(std::move(doubled));
        }
    }
}

}  // namespace
}  // namespace kinora::collada
