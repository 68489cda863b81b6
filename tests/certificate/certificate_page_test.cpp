// The certificate as a page: well-formed, of one piece, with every figure, and with a place for what nobody stated.
#include "certificate/documents.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "html/page_reading.hpp"
#include "made_up_certificate.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

TEST(CertificatePage, IsWellFormedAndNeedsNothingFromElsewhere) {
  for (const Certificate& certificate : {made_up_certificate(), made_up_certificate(200), bare_certificate()}) {
    const std::string page = certificate_html(certificate);
    EXPECT_EQ(unbalanced(page), "");
    for (const char* const word : {"http", "<script", "<link", "@import", "url(", "src=", "nan", "<co>"})
      EXPECT_THAT(page, Not(HasSubstr(word)));
  }
}

TEST(CertificatePage, ShowsTheFigures) {
  const Certificate certificate = made_up_certificate();
  const std::string page = certificate_html(certificate);
  const auto errors = table_of(page, "errors");
  ASSERT_THAT(errors, SizeIs(2));
  EXPECT_EQ(errors[1],
            (std::vector<std::string>{"after: with the calibrated model", "0.071", "0.082", "0.131", "0.187"}));
  EXPECT_EQ(table_of(page, "criteria")[1][3], "not measured");
  EXPECT_THAT(table_of(page, "poses"), SizeIs(certificate.poses.size()));
  EXPECT_EQ(table_of(page, "poses")[0][3], "0.187");
  const std::string words = words_of(page);
  for (const std::string& text : {verdict_sentence(certificate), certificate.remarks.front(), certificate.data_sha256,
                                  certificate.fields.text("customer"), std::string("U = 0.02 mm (k = 2)")}) {
    EXPECT_THAT(words, HasSubstr(text));
  }
}

TEST(CertificatePage, HasAColumnOfApproachesWhereAnyIsRecorded) {
  Certificate certificate = made_up_certificate();
  EXPECT_THAT(words_of(certificate_html(certificate)), Not(HasSubstr("approached")));
  const std::size_t columns = table_of(certificate_html(certificate), "poses")[0].size();
  certificate.poses[1].approach = "+-0+-+";
  const std::string page = certificate_html(certificate);
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_THAT(words_of(page), HasSubstr("approached"));
  const auto rows = table_of(page, "poses");
  EXPECT_THAT(rows[0], SizeIs(columns + 1));
  EXPECT_EQ(rows[1][1], "+-0+-+");
  EXPECT_EQ(rows[0][1], "–");
}

TEST(CertificatePage, ListsTheLargestErrorsOfManyPoses) {
  const std::string page = certificate_html(made_up_certificate(200));
  EXPECT_THAT(table_of(page, "poses"), SizeIs(60));
  EXPECT_THAT(words_of(page), HasSubstr("The 60 largest errors of 200 poses"));
}

TEST(CertificatePage, LeavesBlankAndNamesWhatNobodyStated) {
  const std::string page = certificate_html(bare_certificate());
  EXPECT_THAT(page, HasSubstr("class=\"blank\""));
  EXPECT_THAT(words_of(page), HasSubstr("Not stated, and left blank: Customer; Operator."));
  EXPECT_THAT(words_of(page), HasSubstr("Undecided"));
}

}  // namespace
}  // namespace demecal
