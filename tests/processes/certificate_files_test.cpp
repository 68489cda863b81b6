// The files that demecal certify leaves: signed, and with every name as it was stated.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <tuple>

#include "certified.hpp"

namespace demecal {
namespace {

bool succeeds_in(const std::string& command) {
  return std::system((command + " > /dev/null 2>&1").c_str()) == 0;
}

/// A key and a certificate for it, as NAME-key.pem and NAME.pem.
void make_key(const Certified& robot, const std::string& name) {
  ASSERT_TRUE(succeeds_in("openssl req -x509 -newkey rsa:2048 -nodes -days 30 -subj /CN=" + name + " -keyout '" +
                          robot.path(name + "-key.pem") + "' -out '" + robot.path(name + ".pem") + "'"));
}

TEST(Certify, SignsTheDocumentThatOnlyItsCertificateVerifies) {
  Certified robot;
  make_key(robot, "ours");
  make_key(robot, "theirs");
  const auto signing = [&](const std::string& key, const std::string& certificate) {
    return robot.certify("10", {"--sign", robot.path(key), "--certificate", robot.path(certificate)});
  };
  if (!succeeds_in("xmlsec1 --version")) {
    const Ended without = signing("ours-key.pem", "ours.pem");
    EXPECT_EQ(without.code, 10);
    EXPECT_TRUE(has(without.err, "xmlsec1")) << without.err;
    GTEST_SKIP() << "no xmlsec1 here";
  }
  const Ended ended = signing("ours-key.pem", "ours.pem");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(has(ended.out, "certificate.xml (signed)")) << ended.out;
  const std::string file = robot.path("signed/certificate.xml");
  const auto verifies = [&](const std::string& certificate) {
    return succeeds_in("xmlsec1 --verify --enabled-key-data rsa --pubkey-cert-pem '" + robot.path(certificate) + "' '" +
                       file + "'");
  };
  EXPECT_TRUE(verifies("ours.pem"));
  EXPECT_FALSE(verifies("theirs.pem"));
  std::string text = robot.text("signed/certificate.xml");
  const std::size_t verdict = text.find("undecided");
  ASSERT_NE(verdict, std::string::npos);
  text.replace(verdict, 9, "undecides");
  std::ofstream(file, std::ios::binary) << text;
  EXPECT_FALSE(verifies("ours.pem")) << "it was changed";
  std::filesystem::remove(file);

  for (const auto& [key, certificate, named] :
       {std::tuple("ours-key.pem", "theirs.pem", "theirs.pem"), std::tuple("ours.pem", "ours.pem", "ours.pem"),
        std::tuple("none.pem", "ours.pem", "none.pem")}) {
    const Ended refused = signing(key, certificate);
    EXPECT_EQ(refused.code, 11) << key;
    EXPECT_TRUE(has(refused.err, named)) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(file));
  }
  EXPECT_EQ(robot.certify("10", {"--sign", robot.path("ours-key.pem")}).code, 10);
}

/// Its words, one blank between any two.
std::string joined_words(const std::string& text) {
  std::string joined;
  std::istringstream words(text);
  for (std::string word; words >> word;) joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

TEST(Certify, WritesNamesWithSignsOfMarkupUmlautsAndManyLetters) {
  const std::string customer = "M\xC3\xBCller & S\xC3\xB6hne (GmbH) <x>";
  std::string address =
      "\"Stra\xC3\x9F"
      "e\" 1";
  for (int i = 0; i < 30; ++i) address += " \\(hall) " + std::to_string(i);
  Certified robot("certificate:\n  customer: '" + customer + "'\n  customer_address: '" + address + "'\n");
  ASSERT_EQ(robot.certify("0.5").code, 0);
  const auto read_back = [&](const std::string& file, const std::string& path) {
    const std::string out = robot.path("read.txt");
    EXPECT_EQ(std::system(
                  ("xmllint " + path + " '" + robot.path("signed/" + file) + "' > '" + out + "' 2>/dev/null").c_str()),
              0);
    return joined_words(robot.text("read.txt"));
  };
  for (const std::string& text : {read_back("certificate.html", "--html --xpath 'string(//body)'"),
                                  read_back("certificate.xml", "--xpath 'string(/)'")}) {
    EXPECT_TRUE(has(text, customer)) << text;
    EXPECT_TRUE(has(text, address)) << text;
  }
  if (!std::filesystem::exists(robot.path("signed/certificate.pdf"))) GTEST_SKIP() << "no printer of pages here";
  const std::string words = joined_words(words_of_pdf(robot.path("signed/certificate.pdf")));
  if (words.empty()) GTEST_SKIP() << "no pdftotext here";
  EXPECT_TRUE(has(words, customer)) << words;
  EXPECT_TRUE(has(words, "\\(hall) 29")) << words;
}

}  // namespace
}  // namespace demecal
