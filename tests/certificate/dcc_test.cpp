// The certificate for machines is valid against PTB's schema, whatever the texts in it, and holds the page's figures.
#include "certificate/documents.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "certificate/xml.hpp"
#include "made_up_certificate.hpp"

namespace demecal {
namespace {

const std::filesystem::path kSchemas = std::string(DEMECAL_SOURCE_DIR) + "/../shared/data/dcc";

/// What xmllint says of the document; empty where it is valid.
std::string complaint(const std::string& xml) {
  char name[] = "/tmp/demecal-dcc-XXXXXX";
  const std::filesystem::path folder = ::mkdtemp(name);
  std::ofstream(folder / "certificate.xml", std::ios::binary) << xml;
  const std::string command = "cd '" + kSchemas.string() +
                              "' && XML_CATALOG_FILES=catalog.xml xmllint --nonet --noout " + "--schema dcc321.xsd '" +
                              (folder / "certificate.xml").string() + "' > '" + (folder / "said").string() + "' 2>&1";
  const bool valid = std::system(command.c_str()) == 0;
  std::ifstream said(folder / "said");
  std::string text{std::istreambuf_iterator<char>(said), {}};
  std::filesystem::remove_all(folder);
  return valid ? "" : "xmllint: " + text;
}

class Schema : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kSchemas / "dcc321.xsd")) GTEST_SKIP() << "the schemas are not in " << kSchemas;
  }
};

TEST_F(Schema, AcceptsACertificateWithEverything) {
  EXPECT_EQ(complaint(dcc_xml(made_up_certificate())), "");
}

TEST_F(Schema, AcceptsACertificateForWhichNobodyStatedAnything) {
  const std::string xml = dcc_xml(bare_certificate());
  EXPECT_EQ(complaint(xml), "");
  EXPECT_NE(xml.find("not stated"), std::string::npos);
}

TEST_F(Schema, AcceptsEveryVerdict) {
  for (const double tolerance_m : {1e-3, 1e-5, 1.9e-4}) {
    Certificate certificate = made_up_certificate();
    std::vector<double> errors_m;
    for (const CertifiedPose& pose : certificate.poses) errors_m.push_back(1e-3 * *pose.after_mm);
    certificate.judgement = judge(errors_m, tolerance_m, 0.0, 0.0);
    const std::string xml = dcc_xml(certificate);
    EXPECT_EQ(complaint(xml), "") << tolerance_m;
    EXPECT_NE(xml.find(to_string(certificate.judgement.verdict)), std::string::npos);
  }
}

TEST_F(Schema, AcceptsTextsOfAnyBytes) {
  Certificate certificate = made_up_certificate();
  for (auto& [key, text] : certificate.fields.texts) {
    if (key != "country" && key != "date") text = " \x01 \xFF]]>\xEF\xBF\xBF\n\t<a&b>  \x7F ";
  }
  certificate.robot = certificate.fields.text("robot");
  certificate.poses.front().id = " ";
  EXPECT_EQ(complaint(dcc_xml(certificate)), "");
}

TEST_F(Schema, AcceptsAPlaceForASignature) {
  EXPECT_EQ(complaint(with_empty_signature(dcc_xml(made_up_certificate()))), "");
}

TEST_F(Schema, RefusesWhatIsNoCertificate) {
  std::string xml = dcc_xml(made_up_certificate());
  xml.replace(xml.find("3.2.1"), 5, "9.9.9");
  EXPECT_NE(complaint(xml), "");
}

TEST_F(Schema, AcceptsApproachesOfSomePosesOrAll) {
  Certificate certificate = made_up_certificate();
  EXPECT_EQ(dcc_xml(certificate).find("approached"), std::string::npos);
  certificate.poses[1].approach = "+-0+-+";
  EXPECT_EQ(complaint(dcc_xml(certificate)), "");
  EXPECT_NE(dcc_xml(certificate).find("- +-0+-+ - "), std::string::npos);
}

TEST(DigitalCertificate, HoldsTheFigures) {
  const std::string xml = dcc_xml(made_up_certificate());
  for (const char* const text : {"<si:value>0.071</si:value>", "<si:value>0.187</si:value>", "\\milli\\metre",
                                 "not measured: no pose was measured repeatedly", "the customer &amp; &lt;co&gt;",
                                 "conformity proved", "<dcc:conformity>pass</dcc:conformity>"}) {
    EXPECT_NE(xml.find(text), std::string::npos) << text << "\n" << xml.substr(0, 2000);
  }
}

/// How far the model may be off is no uncertainty of what was measured there.
TEST(DigitalCertificate, StatesThePredictedRadiusAsAQuantityOfItsOwn) {
  const std::string xml = dcc_xml(made_up_certificate());
  EXPECT_EQ(xml.find("expandedUnc"), std::string::npos);
  EXPECT_NE(xml.find("radius that the model predicts to hold 95 % of measured errors"), std::string::npos);
}

TEST(DigitalCertificate, WritesTextsWithoutWhiteSpaceAtTheirEnds) {
  EXPECT_EQ(xml_text(" \n a \t b \x01"), "a b");
  EXPECT_EQ(xml_text("\xFF"), "?");
  EXPECT_EQ(xml_text(""), "");
  EXPECT_EQ(xml_text("\xC3\xA9"), "\xC3\xA9");
}

}  // namespace
}  // namespace demecal
