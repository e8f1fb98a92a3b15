// SPDX-License-Identifier: MIT
#include "output/study_page.h"

#include "output/charts.h"
#include "output/player.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace plumb::test {
namespace {

std::string carried_text(const std::string& page) {
    const std::string opening = "<script id=\"plumb-study\" type=\"application/json\">";
    const std::size_t start = page.find(opening) + opening.size();
    return page.substr(start, page.find("</script>", start) - start);
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
    return count;
}

nlohmann::json small_study(const std::string& name) {
    return {{"title", name},
            {"machine", {{"cpu", name}}},
            {"subjects",
             {{{"name", name},
               {"metric", {{"name", name}, {"unit", "m"}}},
               {"rows", {{{"curve", name}, {"status", "done"}, {"error", 1e-4}, {"us", 12.5}}}},
               {"advice", {name}}}}}};
}

TEST(StudyPage, CarriesTheStudyAndItsOwnScriptOnly) {
    const nlohmann::json study = small_study("pendulum");
    const std::string page = study_page("A study", study.dump());
    EXPECT_EQ(nlohmann::json::parse(carried_text(page)), study);
    EXPECT_NE(page.find("<title>A study"), std::string::npos);
    EXPECT_NE(page.find(charts_script()), std::string::npos);
    EXPECT_EQ(page.find(player_script()), std::string::npos);
    EXPECT_TRUE(page.ends_with("</html>\n"));
}

TEST(StudyPage, NamesCannotBreakOutOfThePage) {
    const std::string evil = "</script><script>alert(1)</script><!-- <b> & \"";
    const std::string usual = study_page("study", small_study("study").dump());
    const std::string page = study_page(evil, small_study(evil).dump());
    EXPECT_EQ(count_of(page, "<script"), count_of(usual, "<script"));
    EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
    EXPECT_NE(page.find("<title>&lt;/script&gt;"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(carried_text(page)), small_study(evil));
    EXPECT_EQ(charts_script().find("</script"), std::string_view::npos);
}

TEST(StudyPage, AsksForNothingFromOutside) {
    std::string page = study_page("study", small_study("study").dump());
    EXPECT_NE(page.find("content=\"default-src 'none'; script-src 'unsafe-inline'"),
              std::string::npos);
    // The addresses that remain are names of vocabularies, which nobody fetches.
    const std::string vocabulary = "http://www.w3.org/";
    for (std::size_t at; (at = page.find(vocabulary)) != std::string::npos;)
        page.erase(at, vocabulary.size());
    for (const char* forbidden : {"http://", "https://", " src=", " href=", "fetch(",
                                  "XMLHttpRequest", "import(", "new Function"}) {
        EXPECT_EQ(page.find(forbidden), std::string::npos) << forbidden;
    }
}

}  // namespace
}  // namespace plumb::test
