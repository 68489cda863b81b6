#include "acceptance/certificate.hpp"
#include "acceptance/iso9283.hpp"
#include "acceptance/verdict.hpp"
#include "certificate/documents.hpp"
#include "data/certificate_fields.hpp"
#include "report/evaluation.hpp"
#include "report/report.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "html/markup.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline certificate {
namespace {

constexpr std::string_view kCertificateStyle = R"css(
@page { size: A4; margin: 18mm 16mm 20mm 16mm;
  @bottom-right { content: "Page " counter(page) " of " counter(pages); font: 9pt sans-serif; color: #444; } }
body { margin: 0 auto; max-width: 178mm; padding: 12px; background: #ffffff; color: #14191e; font: 10.5pt/1.42 "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; }
h1 { font-size: 20pt; margin: 0 0 2pt; } h2 { font-size: 12.5pt; margin: 16pt 0 5pt; border-bottom: 1pt solid #14191e; }
p { margin: 4pt 0; } .small { font-size: 9pt; color: #444b52; }
table { border-collapse: collapse; width: 100%; } th, td { text-align: left; vertical-align: top; padding: 2.5pt 6pt 2.5pt 0; border-bottom: 0.5pt solid #c6cdd3; }
th { font-weight: 600; } td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
.wide { overflow-x: auto; } table.facts th { width: 36%; font-weight: 400; color: #444b52; } td.blank { border-bottom: 0.8pt solid #14191e; }
.verdict { border: 1.5pt solid #14191e; padding: 8pt 10pt; margin: 8pt 0; } .verdict b { font-size: 13pt; }
table.views td { border: 0; padding: 0 4pt 0 0; } svg { max-width: 100%; height: auto; }
table.signatures td { border: 0; padding: 34pt 18pt 0 0; width: 50%; } table.signatures span { display: block; border-top: 0.8pt solid #14191e; padding-top: 3pt; }
.hash { font-family: "DejaVu Sans Mono", Menlo, monospace; font-size: 8pt; overflow-wrap: anywhere; }
@media print { body { max-width: none; padding: 0; } .wide { overflow: visible; } tr, svg, .verdict, .signatures { break-inside: avoid; } h2 { break-after: avoid; } }
)css";

/// Poses listed one by one; of more, those with the largest errors.
constexpr std::size_t kMostListedPoses = 60;

std::string fact_row(const std::string& title, const std::string& value) {
  if (value.empty()) return "<tr><th scope=\"row\">" + escaped(title) + "</th><td class=\"blank\"></td></tr>\n";
  return "<tr><th scope=\"row\">" + escaped(title) + "</th><td>" + escaped(value) + "</td></tr>\n";
}

std::string mm_figure(std::optional<double> value) {
  return fixed(value, 3);
}

std::string document_head(const Certificate& certificate) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\">\n<title>" +
         escaped(certificate.robot) + " – calibration certificate</title>\n<style>" + std::string(kCertificateStyle) +
         "</style>\n</head>\n";
}

std::string people(const Certificate& certificate) {
  std::string rows;
  for (const CertificateField& field : kCertificateFields) {
    const std::string key = field.key;
    std::string value = certificate.fields.text(key);
    if (key == "robot") value = certificate.robot;
    if (value.empty() && !field.expected) continue;
    rows += fact_row(field.title, value);
  }
  if (certificate.fields.instrument_uncertainty_m) {
    rows += fact_row(
        "Uncertainty of the instrument",
        fmt::format("U = {:.10g} mm (k = 2), as stated", millimetres(*certificate.fields.instrument_uncertainty_m)));
  } else {
    rows += fact_row("Uncertainty of the instrument", "");
  }
  rows += fact_row("Date of this document", certificate.issued_on);
  std::string missing;
  for (const std::string& title : certificate.missing) missing += (missing.empty() ? "" : "; ") + escaped(title);
  return "<h2>Whose robot, measured how</h2>\n<table class=\"facts\">\n" + rows + "</table>\n" +
         (missing.empty() ? "" : "<p class=\"small\">Not stated, and left blank: " + missing + ".</p>\n");
}

std::string verdict(const Certificate& certificate) {
  const Judgement& judged = certificate.judgement;
  const std::string remedy = remedy_sentence(certificate);
  const auto limit = [](const std::optional<double>& value_m) {
    return value_m ? fmt::format("{:.3f} mm", millimetres(*value_m)) : std::string("none with so few poses");
  };
  std::string rows = fact_row("Tolerance", fmt::format("{:.10g} mm", millimetres(judged.tolerance_m)));
  rows += fact_row(
      fmt::format("Error that {:.0f} % of the judged {} keep within", 100.0 * kAcceptedShare, certificate.words.poses),
      fmt::format("{:.3f} mm", millimetres(judged.error_m)));
  rows +=
      fact_row(fmt::format("The same of all {} like these, at most ({:.1f} % confidence{})", certificate.words.poses,
                           100.0 * kConfidence, judged.assumes_normal ? " if errors are normally distributed" : ""),
               limit(judged.upper_m));
  rows += fact_row(fmt::format("and at least ({:.1f} % confidence)", 100.0 * kConfidence), limit(judged.lower_m));
  rows += fact_row(
      "Guard band below the tolerance, above it (k = 2)",
      fmt::format("{:.3f} mm, {:.3f} mm", millimetres(judged.guard_below_m), millimetres(judged.guard_above_m)));
  rows += fact_row(
      "Judged, of these beyond the tolerance",
      fmt::format("{} {} {}, {}", judged.poses, certificate.judged_set, certificate.words.poses, judged.beyond));
  return "<div class=\"verdict\" id=\"verdict\"><b>" + escaped(to_string(judged.verdict)) + "</b><p>" +
         escaped(verdict_sentence(certificate)) + "</p>" + (remedy.empty() ? "" : "<p>" + escaped(remedy) + "</p>") +
         "</div>\n<table class=\"facts\">\n" + rows +
         "</table>\n<p class=\"small\">Decision rule: ISO 14253-1. Conformity is proved where the upper limit and the "
         "guard band below the tolerance stay within it, non-conformity where the lower limit less the guard band "
         "above "
         "still exceeds it; between the two nothing is proved. A wrong verdict at the tolerance itself has a "
         "probability of at most 2.5 %" +
         (judged.assumes_normal ? " (conformity: if errors are normally distributed)" : "") + ".</p>\n";
}

std::string results(const Certificate& certificate) {
  const auto row = [](const std::string& words, const SetErrors& errors) {
    std::string cells;
    for (const std::optional<double>& value : {errors.mean_mm, errors.rms_mm, errors.p95_mm, errors.max_mm})
      cells += "<td class=\"number\">" + mm_figure(value) + "</td>";
    return "<tr><th scope=\"row\">" + escaped(words) + "</th>" + cells + "</tr>\n";
  };
  return fmt::format(
             "<h2>Before and after calibration: {}</h2>\n<table id=\"errors\">\n<thead><tr><th>{} {} "
             "measurements, mm</th>",
             certificate.words.quantity, certificate.judged_rows, certificate.judged_set) +
         "<th class=\"number\">mean</th><th class=\"number\">rms</th><th class=\"number\">P95</th>"
         "<th class=\"number\">largest</th></tr></thead>\n<tbody>\n" +
         row("before: " + certificate.before_words, certificate.before) +
         row("after: with the calibrated model", certificate.after) + "</tbody></table>\n";
}

std::string criteria(const Certificate& certificate) {
  std::string rows;
  for (const Characteristic& one : certificate.characteristics) {
    rows += "<tr><th scope=\"row\">" + escaped(one.symbol) + "</th><td>" + escaped(one.title) + "</td><td>" +
            escaped(one.clause) + "</td><td class=\"number\">" +
            (one.value_mm ? mm_figure(one.value_mm) + " mm" : std::string("not measured")) + "</td><td>" +
            escaped(one.basis) + "</td></tr>\n";
  }
  return "<h2>Performance criteria (ISO 9283)</h2>\n<table id=\"criteria\">\n<thead><tr><th></th><th>criterion</th><th>"
         "clause</th><th class=\"number\">value</th><th>of</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n<p class=\"small\">" + escaped(not_implemented()) + "</p>\n";
}

std::string budget(const Certificate& certificate) {
  if (!certificate.uncertainty) return {};
  const UncertaintyEntry& entry = *certificate.uncertainty;
  std::string rows;
  for (const UncertaintyContribution& one : entry.contributions) {
    rows += "<tr><th scope=\"row\">" + escaped(one.name) + "</th><td>type " + escaped(one.type) +
            "</td><td class=\"number\">" + (one.standard_mm ? mm_figure(one.standard_mm) : std::string("not stated")) +
            "</td></tr>\n";
  }
  rows +=
      "<tr><th scope=\"row\">standard uncertainty</th><td></td><td class=\"number\">" + mm_figure(entry.standard_mm) +
      "</td></tr>\n<tr><th scope=\"row\">expanded uncertainty, k = 2, about 95 %</th><td></td><td class=\"number\">" +
      mm_figure(entry.expanded_mm) + "</td></tr>\n";
  return "<h2>Uncertainty of a corrected position</h2>\n<table id=\"uncertainty\">\n<thead><tr><th>contribution</th>"
         "<th></th><th class=\"number\">mm</th></tr></thead>\n<tbody>\n" +
         rows +
         "</tbody></table>\n<p class=\"small\">Root mean square over the judged poses, without measurement noise: " +
         escaped(entry.remark) + ".</p>\n";
}

std::string conditions_section(const Certificate& certificate) {
  std::string rows;
  for (const Condition& one : certificate.conditions) {
    rows +=
        fact_row(one.name + ", " + one.unit, one.lower && one.upper ? fixed(one.lower, 2) + " to " + fixed(one.upper, 2)
                                                                    : std::string("not recorded"));
  }
  return "<h2>Conditions</h2>\n<table class=\"facts\" id=\"conditions\">\n" + rows + "</table>\n";
}

/// Of the measurements of a pose, whose mean may be within.
std::string beyond_text(const CertifiedPose& pose) {
  if (pose.measurements < 2) return "beyond the tolerance";
  return "single measurements beyond the tolerance, to " + mm_figure(pose.single_mm) + " mm";
}

std::string pose_list(const Certificate& certificate) {
  const bool approached =
      std::ranges::any_of(certificate.poses, [](const CertifiedPose& pose) { return !pose.approach.empty(); });
  const auto side = [](const CertifiedPose& pose) {
    return "<td>" + (pose.approach.empty() ? std::string("–") : escaped(pose.approach)) + "</td>";
  };
  std::string rows;
  const std::size_t shown = std::min(kMostListedPoses, certificate.poses.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const CertifiedPose& pose = certificate.poses[i];
    rows += "<tr><th scope=\"row\">" + escaped(pose.id) + (pose.target.empty() ? "" : " " + escaped(pose.target)) +
            "</th>" + (approached ? side(pose) : std::string()) +
            fmt::format(
                "<td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
                "<td class=\"number\">{}</td><td>{}</td></tr>\n",
                pose.measurements, mm_figure(pose.before_mm), mm_figure(pose.after_mm), mm_figure(pose.uncertainty_mm),
                pose.beyond ? beyond_text(pose) : std::string());
  }
  const std::string title =
      shown < certificate.poses.size()
          ? fmt::format("The {} largest errors of {} {}", shown, certificate.poses.size(), certificate.words.poses)
          : "Judged " + certificate.words.poses;
  return "<h2>" + title + "</h2>\n<div class=\"wide\"><table id=\"poses\">\n<thead><tr><th>pose</th>" +
         (approached ? "<th>joints approached from</th>" : "") + "<th class=\"number\">measurements</th>" +
         fmt::format("<th class=\"number\">{0} before, mm</th><th class=\"number\">{0} after, mm</th>",
                     certificate.words.of_one) +
         "<th class=\"number\">95 % of errors within, mm</th><th></th></tr></thead>\n<tbody>\n" + rows +
         "</tbody></table></div>\n";
}

std::string provenance_section(const Certificate& certificate) {
  const auto hash = [](const std::string& title, const std::string& value) {
    return "<tr><th scope=\"row\">" + title + "</th><td class=\"hash\">" + escaped(value) + "</td></tr>\n";
  };
  return "<h2>What this rests on</h2>\n<table class=\"facts\">\n" + fact_row("Data", certificate.data_name) +
         hash("SHA-256 of the data", certificate.data_sha256) +
         fact_row("Model", "job " + certificate.job + ", demecal " + certificate.model_version) +
         hash("SHA-256 of the model", certificate.model_sha256) +
         hash("SHA-256 of the data it was calibrated with", certificate.model_data_sha256) +
         fact_row("This document was made by", "demecal " + certificate.version) + "</table>\n";
}

std::string remarks(const Certificate& certificate) {
  std::string items;
  for (const std::string& remark : certificate.remarks) items += "<li>" + escaped(remark) + "</li>\n";
  return items.empty() ? items : "<h2>Remarks</h2>\n<ul id=\"remarks\">\n" + items + "</ul>\n";
}

constexpr std::string_view kSignatures =
    "<table class=\"signatures\"><tr><td><span>Date, name and signature: calibration</span></td><td><span>Date, name "
    "and signature: customer</span></td></tr></table>\n";

}  // namespace

std::string certificate_html(const Certificate& certificate) {
  const std::string number = certificate.fields.text("certificate_number");
  return document_head(certificate) + "<body>\n<h1>Calibration certificate</h1>\n<p>" + escaped(certificate.robot) +
         (number.empty() ? "" : " · " + escaped(number)) + "</p>\n" + verdict(certificate) + results(certificate) +
         remarks(certificate) + people(certificate) + criteria(certificate) + budget(certificate) +
         conditions_section(certificate) + "<h2>Measured volume</h2>\n" +
         volume_picture(certificate.view, certificate.judgement.tolerance_m) + pose_list(certificate) +
         provenance_section(certificate) + std::string(kSignatures) + "</body>\n</html>\n";
}

}  // namespace demecal::inline certificate
