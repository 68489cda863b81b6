#include "prediction/link_text.hpp"

#include <array>
#include <charconv>
#include <cstddef>

namespace demecal::inline prediction {
namespace {

std::string digits(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// The parameters of one link as text.
struct LinkText {
  std::string theta, d, a, alpha, beta;
};

LinkText link_text(const Chain& chain, int joint, LinkNumbers numbers) {
  const Joint& link = chain.joints[static_cast<std::size_t>(joint)];
  const auto parameter = [&](LinkParameter which) {
    const bool moves = which == moving_parameter(link);
    const double value = link.parameter(which);
    const std::string fixed = numbers == LinkNumbers::named ? parameter_name(which, joint) : digits(value);
    if (!moves) return fixed;
    const std::string variable = 'q' + std::to_string(joint + 1);
    return fixed == "0" ? variable : '(' + variable + " + " + fixed + ')';
  };
  return {parameter(LinkParameter::theta), parameter(LinkParameter::d), parameter(LinkParameter::a),
          parameter(LinkParameter::alpha), parameter(LinkParameter::beta)};
}

std::string times(const std::string& a, const std::string& b) {
  return '(' + a + ")*(" + b + ')';
}
std::string minus(const std::string& a) {
  return "-(" + a + ')';
}

/// Rz Tz Tx Rx.
MatrixText standard_text(const LinkText& link) {
  const std::string c = "cos(" + link.theta + ')', s = "sin(" + link.theta + ')';
  const std::string ca = "cos(" + link.alpha + ')', sa = "sin(" + link.alpha + ')';
  return {{{c, minus(times(s, ca)), times(s, sa), times(link.a, c)},
           {s, times(c, ca), minus(times(c, sa)), times(link.a, s)},
           {"0", sa, ca, link.d}}};
}

/// Rx Tx Rz Tz.
MatrixText modified_text(const LinkText& link) {
  const std::string c = "cos(" + link.theta + ')', s = "sin(" + link.theta + ')';
  const std::string ca = "cos(" + link.alpha + ')', sa = "sin(" + link.alpha + ')';
  return {{{c, minus(s), "0", link.a},
           {times(s, ca), times(c, ca), minus(sa), minus(times(link.d, sa))},
           {times(s, sa), times(c, sa), ca, times(link.d, ca)}}};
}

MatrixText about_y_text(const std::string& angle) {
  const std::string c = "cos(" + angle + ')', s = "sin(" + angle + ')';
  return {{{c, "0", s, "0"}, {"0", "1", "0", "0"}, {minus(s), "0", c, "0"}}};
}

}  // namespace

std::string parameter_name(LinkParameter parameter, int joint) {
  static const std::array<const char*, kLinkParameters> names{"theta", "d", "a", "alpha", "beta"};
  return names.at(static_cast<std::size_t>(parameter)) + std::to_string(joint + 1);
}

std::vector<MatrixText> link_texts(const Chain& chain, LinkNumbers numbers) {
  std::vector<MatrixText> texts;
  for (int joint = 0; joint < chain.size(); ++joint) {
    const LinkText link = link_text(chain, joint, numbers);
    const bool standard = chain.convention == Convention::standard_dh;
    if (link.beta == "0") {
      texts.push_back(standard ? standard_text(link) : modified_text(link));
    } else if (standard) {
      texts.push_back(standard_text(link));
      texts.push_back(about_y_text(link.beta));
    } else {  // Rx Tx Ry Rz Tz
      texts.push_back(modified_text({"0", "0", link.a, link.alpha, "0"}));
      texts.push_back(about_y_text(link.beta));
      texts.push_back(modified_text({link.theta, link.d, "0", "0", "0"}));
    }
  }
  return texts;
}

}  // namespace demecal::inline prediction
