// tests/collada/growth_test.cpp: work grows with the file, not with its square. Counted in
// instructions or, where the system does not count them for us, in CPU time, of which only how it
// grows is asked; folders are counted as listed.
#include <gtest/gtest.h>
#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>

#include "collada/document/id_path.h"
#include "collada/extract/extract.h"
#include "collada/extract/extract_p.h"
#include "collada/validate/validate.h"
#include "tests/collada/reading.h"

namespace kinora::collada {
namespace {

// What this thread spends: instructions in user mode, which nothing disturbs; else CPU time, ns.
class Cost {
  public:
    Cost() {
        perf_event_attr what{};
        what.type = PERF_TYPE_HARDWARE;
        what.size = sizeof what;
        what.config = PERF_COUNT_HW_INSTRUCTIONS;
        what.exclude_kernel = what.exclude_hv = 1;
        file_ = int(syscall(SYS_perf_event_open, &what, 0, -1, -1, 0));
        exact_ = instructions() >= 0;
    }
    ~Cost() {
        if (file_ >= 0) close(file_);
    }
    Cost(const Cost&) = delete;
    bool exact() const { return exact_; }
    int64_t now() const { return exact_ ? instructions() : cpu_time(); }

  private:
    int64_t instructions() const {
        int64_t count = -1;
        return file_ >= 0 && read(file_, &count, sizeof count) == sizeof count ? count : -1;
    }
    static int64_t cpu_time() {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return int64_t(t.tv_sec) * 1'000'000'000 + t.tv_nsec;
    }

    int file_;
    bool exact_;
};

using Numbered = std::string (*)(const std::string& number);
std::string repeat(size_t n, Numbered text) {
    std::string out;
    for (size_t i = 0; i < n; ++i) out += text(std::to_string(i));
    return out;
}

std::string effect(const std::string& params, const std::string& shading, size_t materials = 1,
                   const std::string& setparams = "") {
    std::string out =
        "<library_images><image id=\"im\"><init_from>none.png</init_from></image></library_images>"
        "<library_effects><effect id=\"e\"><profile_COMMON>" +
        params + "<technique sid=\"t\"><phong>" + shading +
        "</phong></technique></profile_COMMON></effect></library_effects><library_materials>";
    for (size_t i = 0; i < materials; ++i)
        out += "<material id=\"m" + std::to_string(i) + "\"><instance_effect url=\"#e\">" +
               setparams + "</instance_effect></material>";
    return out + "</library_materials>";
}
const char* const kDiffuse = "<diffuse><color>1 1 1 1</color></diffuse>";

std::string groups(size_t n) {
    return with_mesh("0 0 0 1 0 0 0 1 0", 3, repeat(n, [](const std::string& i) {
                         return "<triangles count=\"1\" material=\"s" + i +
                                "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>"
                                "<p>0 1 2</p></triangles>";
                     }));
}

struct Case {
    const char* name;
    std::string (*text)(size_t n);
    size_t few = 10'000;  // less where a limit or the caches would be passed
};
void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

const Case kCases[] = {
    {"textures_by_newparams",
     [](size_t n) {
         return with_scene(effect(repeat(n,
                                         [](const std::string& i) {
                                             return "<newparam sid=\"p" + i +
                                                    "\"><sampler2D><source>q</source></sampler2D>"
                                                    "</newparam>";
                                         }),
                                  repeat(n,
                                         [](const std::string& i) {
                                             return "<diffuse><texture texture=\"p" + i +
                                                    "\" texcoord=\"a\"/></diffuse>";
                                         })),
                           "<node/>");
     },
     2500},
    {"setparams_by_newparams",
     [](size_t n) {
         return with_scene(
             effect(repeat(n,
                           [](const std::string& i) {
                               return "<newparam sid=\"p" + i + "\"><float>1</float></newparam>";
                           }),
                    kDiffuse, 1,
                    repeat(n,
                           [](const std::string& i) {
                               return "<setparam ref=\"p" + i + "\"><float>1</float></setparam>";
                           })),
             "<node/>");
     },
     2500},
    {"groups_by_instances",
     [](size_t n) {
         std::string mesh = groups(n);
         std::string library = effect("", kDiffuse);
         size_t at = mesh.find("<library_geometries");
         mesh.insert(at, library);
         std::string instances = repeat(n, [](const std::string&) -> std::string {
             return "<node><instance_geometry url=\"#g\"><bind_material><technique_common>"
                    "<instance_material symbol=\"s7\" target=\"#m0\"/></technique_common>"
                    "</bind_material></instance_geometry></node>";
         });
         at = mesh.find("</visual_scene>");
         mesh.insert(at, instances);
         return mesh;
     }},
    {"unknown_attributes",
     [](size_t n) {
         return with_scene("", "<node " + repeat(n, [](const std::string& i) {
                                   return "a" + i + "=\"1\" ";
                               }) + "/>");
     },
     2500},
    {"unknown_elements",
     [](size_t n) {
         return with_scene("", "<node>" + repeat(n, [](const std::string& i) {
                                   return "<unheardof" + i + "/>";
                               }) + "</node>");
     }},
    {"foreign_prefixes",
     [](size_t n) {
         std::string declared =
             repeat(n, [](const std::string& i) { return " xmlns:a" + i + "=\"urn:a" + i + "\""; });
         return with_scene("",
                           "<node" + declared + "><extra><technique profile=\"x\">" +
                               repeat(n, [](const std::string& i) { return "<a" + i + ":b/>"; }) +
                               "</technique></extra></node>");
     },
     2500},
    {"children_too_many",
     [](size_t n) {
         return with_scene("", "<node>" + repeat(n, [](const std::string&) -> std::string {
                                   return "<asset/>";
                               }) + "</node>");
     }},
    {"children_out_of_order",
     [](size_t n) {
         return with_scene("", "<node>" + repeat(n, [](const std::string&) -> std::string {
                                   return "<node/><translate>1 2 3</translate>";
                               }) + "</node>");
     }},
    {"holes_of_one_polygon",
     [](size_t n) {
         return with_mesh(
             "0 0 0 9 0 0 9 9 0 0 9 0 1 1 0 2 1 0 2 2 0", 7,
             "<polygons count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" "
             "offset=\"0\"/><ph><p>0 1 2 3</p>" +
                 repeat(n / 4, [](const std::string&) -> std::string { return "<h>4 5 6</h>"; }) +
                 "</ph></polygons>");
     },
     2500},
    {"ids_that_are_the_same",
     [](size_t n) {
         return with_scene(
             "", repeat(n, [](const std::string&) -> std::string { return "<node id=\"n\"/>"; }));
     }},
    {"links_that_lead_nowhere",
     [](size_t n) {
         return with_scene("", "<node>" + repeat(n, [](const std::string& i) {
                                   return "<instance_node url=\"#none" + i + "\"/>";
                               }) + "</node>");
     }},
};

// What a user's run does: validation, id paths, and each finding as text.
void work(const std::string& text) {
    Reading r;
    r.document = read_document_text("test.dae", text, r.diag);
    ASSERT_TRUE(r.document) << r.all();
    r.scene = validate(*r.document, r.diag);
    std::vector<Finding> findings = r.diag.findings();
    add_id_paths(*r.document, r.diag.files, findings);
    size_t said = 0;
    for (const Finding& f : findings) said += format_finding(f, r.diag.files).size();
    EXPECT_GT(said, 0u);
}

class Growth : public testing::TestWithParam<Case> {};

// A large file beside eight of an eighth of it: 1 if work is linear, 8 if it goes with the square.
// Both take about as long, so that what else runs here disturbs both alike; the median of rounds
// forgets when it does not. Sorting, and tables that outgrow caches, cost a little more than
// linear.
TEST_P(Growth, IsNearLinear) {
    constexpr size_t kTimes = 8;
    const std::string few = GetParam().text(GetParam().few);
    const std::string many = GetParam().text(kTimes * GetParam().few);
    const Cost cost;
#if defined(KINORA_SANITIZED)
    if (!cost.exact()) GTEST_SKIP() << "CPU time is judged without the sanitizer's own share";
#endif
    const size_t rounds = cost.exact() ? 1 : 3;
    work(few);  // the tables of the format are made, and memory is had
    std::vector<double> growths;
    for (size_t round = 0; round < rounds; ++round) {
        int64_t begin = cost.now();
        for (size_t k = 0; k < kTimes; ++k) work(few);
        int64_t between = cost.now();
        work(many);
        growths.push_back(double(cost.now() - between) / double(between - begin));
    }
    std::sort(growths.begin(), growths.end());
    RecordProperty("growth", testing::PrintToString(growths));
    EXPECT_LT(growths[rounds / 2], cost.exact() ? 1.6 : 3.0) << testing::PrintToString(growths);
}

INSTANTIATE_TEST_SUITE_P(Cases, Growth, testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

struct Folder {
    std::string path;
    explicit Folder(const std::string& name) : path(testing::TempDir() + name + "/") {
        std::filesystem::remove_all(path);
        std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
    void file(const std::string& name, const std::string& text) const {
        std::ofstream(path + name, std::ios::binary) << text;
    }
};

TEST(MissingImages, ListTheirFolderOnce) {
    Folder above("kinora_growth_images");
    Folder folder("kinora_growth_images/scene");
    for (int i = 0; i < 20; ++i) folder.file("Wood" + std::to_string(i) + ".JPG", "x");
    folder.file("main.dae", with_scene("<library_images>" +
                                           repeat(500,
                                                  [](const std::string& i) {
                                                      return "<image id=\"i" + i +
                                                             "\"><init_from>wood" + i +
                                                             ".png</init_from></image>";
                                                  }) +
                                           "</library_images>",
                                       "<node/>"));
    Reading r;
    r.document = read_document(folder.path + "main.dae", r.diag);
    ASSERT_TRUE(r.document);
    ExtractOptions options;
    options.everything = true;
    Extraction x(r.diag, options);
    ASSERT_TRUE(extract_into(x, *r.document));
    // Five by name, and the last four folders of the path in three ones, two of which are this one.
    EXPECT_EQ(x.pictures.folder_count(), 15u);  // all but this one are not there
    EXPECT_EQ(x.pictures.listed_files(), 21u);
    EXPECT_EQ(r.count("FILE_FALLBACK"), 20u);
    EXPECT_EQ(r.count("FILE_MISSING"), 480u);
    ASSERT_EQ(x.scene.images.size(), 500u);
    EXPECT_EQ(x.scene.images[7].path, folder.path + "Wood7.JPG");
}

std::string library_of(const std::string& content) {
    return "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
           "<asset><created>2026-01-01T00:00:00Z</created><modified>2026-01-01T00:00:00Z"
           "</modified></asset>" +
           content + "</COLLADA>";
}

std::string cycle(const std::string& path) {
    Reading r;
    r.document = read_document(path, r.diag);
    if (!r.document) return "unread";
    validate(*r.document, r.diag);
    std::string all;
    for (const Finding& f : r.diag.findings())
        if (f.info->code == std::string_view("LINK_CYCLE"))
            all += f.message + " at " +
                   std::filesystem::path(r.diag.files.name(f.where.file)).filename().string() +
                   "\n";
    return all;
}

TEST(Cycles, AcrossDocumentsAreNamedAsALoop) {
    Folder folder("kinora_growth_cycles");
    folder.file("a.dae", with_scene("", "<node id=\"x\"><instance_node url=\"b.dae#y\"/></node>"));
    folder.file("b.dae", library_of("<library_nodes><node id=\"y\"><node id=\"in\"><instance_node "
                                    "url=\"./sub/../c.dae#z\"/></node></node></library_nodes>"));
    folder.file("c.dae", library_of("<library_nodes><node id=\"z\"><instance_node "
                                    "url=\"a.dae#x\"/></node></library_nodes>"));
    EXPECT_EQ(cycle(folder.path + "a.dae"),
              "a cycle: 'a.dae#x' -> 'b.dae#y' -> 'b.dae#in' -> 'c.dae#z' -> 'a.dae#x' at c.dae\n");
    // A loop that does not touch the first document.
    folder.file("d.dae", with_scene("", "<node id=\"r\"><instance_node url=\"e.dae#e\"/></node>"));
    folder.file("e.dae", library_of("<library_nodes><node id=\"e\"><instance_node url=\"f.dae#f\"/>"
                                    "</node></library_nodes>"));
    folder.file("f.dae", library_of("<library_nodes><node id=\"f\"><instance_node url=\"e.dae#e\"/>"
                                    "</node></library_nodes>"));
    EXPECT_EQ(cycle(folder.path + "d.dae"),
              "a cycle: 'e.dae#e' -> 'f.dae#f' -> 'e.dae#e' at f.dae\n");
    // No loop: the same file on two ways.
    folder.file("f.dae", library_of("<library_nodes><node id=\"f\"/></library_nodes>"));
    EXPECT_EQ(cycle(folder.path + "d.dae"), "");
}

TEST(Cycles, OfControllersAcrossDocumentsAreNamed) {
    Folder folder("kinora_growth_controllers");
    auto controller = [](const char* id, const char* source) {
        return std::string("<library_controllers><controller id=\"") + id + "\"><morph source=\"" +
               source + "\"><targets/></morph></controller></library_controllers>";
    };
    folder.file("a.dae", with_scene(controller("one", "b.dae#two"),
                                    "<node><instance_controller url=\"#one\"/></node>"));
    folder.file("b.dae", library_of(controller("two", "a.dae#one")));
    EXPECT_EQ(cycle(folder.path + "a.dae"),
              "a cycle: 'a.dae#one' -> 'b.dae#two' -> 'a.dae#one' at b.dae\n");
}

}  // namespace
}  // namespace kinora::collada
