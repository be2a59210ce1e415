// tests/rsl/parser_test.cpp: trees, seen through their printed form.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "rsl/syntax/print.h"
#include "tests/rsl/source_text.h"

namespace kinora::rsl {
namespace {

// The expression with every operator in parentheses.
std::string grouped(const std::string& expression) {
    TestSource source("surface x() { " + expression + "; }");
    auto ast = parse(source.source, {}, source.diagnostics);
    if (!ast) return source.messages();
    const auto& stmt = as<ExpressionStmt>(*ast->shaders[0]->body->body[0]);
    return print_expr(*stmt.expression, [](const Expr& e, std::string text) {
        bool leaf = e.kind == ExprKind::Variable || e.kind == ExprKind::Number;
        return leaf ? text : "<" + text + ">";
    });
}

TEST(Parser, BindsOperatorsAsTheSpecificationSays) {
    EXPECT_EQ(grouped("a * b . c"), "<a * <b . c>>");
    EXPECT_EQ(grouped("a ^ b * c"), "<a ^ <b * c>>");
    EXPECT_EQ(grouped("a + b ^ c"), "<a + <b ^ c>>");
    EXPECT_EQ(grouped("a - b - c"), "<<a - b> - c>");
    EXPECT_EQ(grouped("a < b == c > d"), "<<a < b> == <c > d>>");
    EXPECT_EQ(grouped("a || b && c"), "<a || <b && c>>");
    EXPECT_EQ(grouped("a = b = c ? d : e"), "<a = <b = <c ? d : e>>>");
    EXPECT_EQ(grouped("-a . b"), "<<-a> . b>");
}

TEST(Parser, ACastBindsAsAPrefixOperator) {
    EXPECT_EQ(grouped("float f(P) * 2"), "<<float <f(P)>> * 2>");
    EXPECT_EQ(grouped("(float) a + b"), "<<float a> + b>");
    EXPECT_EQ(grouped("color \"hsv\" (1, 2, 3) * a"), "<<color <\"hsv\"> <(1, 2, 3)>> * a>");
}

TEST(Parser, PrintingAndParsingAgainGivesTheSameTree) {
    int files = 0;
    for (const auto& path : shader_files("tests/rsl/files")) {
        TestSource source(read_file(path));
        auto ast = parse(source.source, {}, source.diagnostics);
        if (!ast) continue;  // one of the files with syntax errors
        std::string once = print_ast(*ast);
        TestSource again(once);
        auto second = parse(again.source, {}, again.diagnostics);
        ASSERT_TRUE(second) << path << "\n" << again.messages() << once;
        EXPECT_EQ(print_ast(*second), once) << path;
        ++files;
    }
    EXPECT_GE(files, 30);
}

TEST(Parser, APrintedCheckedTreeChecksAgain) {
    for (const auto& path : shader_files("tests/rsl/files/good")) {
        TestSource source(read_file(path));
        auto shaders = compile(source.source, front_end_only(), source.diagnostics);
        ASSERT_FALSE(shaders.empty()) << source.messages();
        TestSource again(print_ast(*shaders[0]->ast));
        auto second = compile(again.source, front_end_only(), again.diagnostics);
        ASSERT_EQ(second.size(), shaders.size()) << path << again.messages() << again.text;
        EXPECT_EQ(print_types(*second[0]->ast), print_types(*shaders[0]->ast)) << path;
    }
}

TEST(Parser, DeepNestingIsAnErrorNotACrash) {
    for (const char* piece : {"(", "-", "!", "a[", "f(", "{", "if (a) ", "a ? ", "a = ", "a + (",
                              "float ", "while (a) {"}) {
        std::string text = "surface x() { ";
        for (int i = 0; i < 100000; ++i) text += piece;
        TestSource source(text);
        compile(source.source, front_end_only(), source.diagnostics);
        EXPECT_TRUE(source.diagnostics.has_errors()) << piece;
    }
}

TEST(Parser, ALargeArrayLiteralIsLinear) {
    std::string text = "surface x(float a[65536] = {0";
    for (int i = 1; i < 65536; ++i) text += ",1";
    TestSource source(text + "};) { Ci = a[s]; }");
    auto shaders = compile(source.source, front_end_only(), source.diagnostics);
    ASSERT_EQ(shaders.size(), 1u) << source.messages();
    EXPECT_EQ(shaders[0]->parameters[0].constant->numbers.size(), 65536u);
}

}  // namespace
}  // namespace kinora::rsl
