// JSON that lacks keys is read; JSON of the wrong kind is refused by name.
#include "report/json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "errors/input_error.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

JsonValue read(const std::string& text) {
  return JsonValue::parse(text, "report.json");
}

std::string complaint(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& fault) {
    EXPECT_EQ(fault.where().file, "report.json");
    return fault.what();
  }
  return "none";
}

TEST(JsonValue, ReadsEveryKind) {
  const JsonValue json = read(R"({"a": {"b": [1, 2.5]}, "c": "text", "d": true, "e": 18446744073709551615})");
  EXPECT_THAT(json["a"]["b"].numbers(), ElementsAre(1.0, 2.5));
  EXPECT_EQ(json["c"].text(), "text");
  EXPECT_EQ(json["d"].boolean(), true);
  EXPECT_EQ(json["e"].count(), 18446744073709551615u);
  EXPECT_EQ(json.members().size(), 4u);
  EXPECT_EQ(json.members()[2].first, "d");
}

TEST(JsonValue, IsMissingWhereKeysAreAbsentOrNull) {
  const JsonValue json = read(R"({"none": null})");
  for (const JsonValue& missing : {json["none"], json["absent"], json["absent"]["deeper"]}) {
    EXPECT_FALSE(missing.exists());
    EXPECT_EQ(missing.number(), std::nullopt);
    EXPECT_EQ(missing.count(), std::nullopt);
    EXPECT_EQ(missing.boolean(), std::nullopt);
    EXPECT_EQ(missing.text(), "");
    EXPECT_THAT(missing.elements(), IsEmpty());
    EXPECT_THAT(missing.members(), IsEmpty());
  }
}

TEST(JsonValue, NamesPathAndValueOfTheWrongKind) {
  const JsonValue json = read(R"({"a": [{"b": "x"}], "n": -1})");
  const JsonValue text = json["a"].elements()[0]["b"];
  EXPECT_EQ(complaint([&] { text.number(); }), "report.json: '\"x\"': a[0].b must be a number");
  EXPECT_THAT(complaint([&] { text.elements(); }), HasSubstr("a[0].b must be a list"));
  EXPECT_THAT(complaint([&] { text["c"]; }), HasSubstr("a[0].b must be an object"));
  EXPECT_THAT(complaint([&] { text.members(); }), HasSubstr("a[0].b must be an object"));
  EXPECT_THAT(complaint([&] { text.boolean(); }), HasSubstr("a[0].b must be true or false"));
  EXPECT_THAT(complaint([&] { json["n"].count(); }), HasSubstr("n must be a whole number"));
  EXPECT_THAT(complaint([&] { json["n"].text(); }), HasSubstr("n must be a text"));
  EXPECT_THAT(complaint([] { read("[1]")["a"]; }), HasSubstr("the whole document must be an object"));
}

TEST(JsonValue, NamesTheLineWhereTextIsNoJson) {
  EXPECT_EQ(complaint([] { read("{\n  \"a\": 1,\n  oops\n}"); }), "report.json:3: is not JSON from column 3");
  EXPECT_EQ(complaint([] { read("{\"a\": \n"); }), "report.json:2: ends before its JSON is complete");
  EXPECT_EQ(complaint([] { read(""); }), "report.json:1: ends before its JSON is complete");
  EXPECT_THAT(complaint([] { read("{\"a\": 1e999}"); }), HasSubstr("a number too large"));
  EXPECT_THAT(complaint([] { read("{\"a\": \"\xFF\"}"); }), HasSubstr("is not JSON"));
}

TEST(JsonValue, EveryCutOffDocumentIsRefused) {
  const std::string whole = R"({"a": [1, {"b": "c\u00e9"}, null], "d": -2.5e3})";
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_NE(complaint([&] { read(whole.substr(0, length)); }), "none") << whole.substr(0, length);
  }
}

}  // namespace
}  // namespace demecal
