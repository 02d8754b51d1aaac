// The only file that knows muParser.
#include "model/field.hpp"

#include <muParser.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <iomanip>
#include <mutex>
#include <numbers>
#include <regex>
#include <sstream>

#include "base/printable.hpp"

namespace mortise {
namespace {

constexpr std::size_t longest_expression = 1000;
constexpr std::array names{"x", "y", "r", "theta", "s"};
enum Name { x_, y_, r_, theta_, s_ };

// The name that starts at `at`; empty if none does.
std::string name_at(const std::string& text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_')) ++end;
  return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) ? "" : text.substr(at, end - at);
}

[[noreturn]] void fail_parsing(const std::string& text, const mu::ParserError& error, const FieldUse& use) {
  const std::size_t at = error.GetPos() < 0 ? 0 : std::min(std::size_t(error.GetPos()), text.size());
  if (const std::string name = name_at(text, at); error.GetCode() == mu::ecUNASSIGNABLE_TOKEN && !name.empty()) {
    std::vector<std::string> known(names.begin(), names.end() - (use.on_curve ? 0 : 1));
    known.push_back("pi");
    for (const auto& [constant, value] : use.constants) known.push_back(constant);
    for (const auto& function : use.functions) known.push_back(function->name);
    std::string trouble = unknown_name("name", name, known) + ", and functions such as sin, sqrt, exp";
    if (name == "s" && !use.on_curve) trouble = "s, the arc length, is known on curves only; known: x, y, r, theta, pi";
    throw ExpressionError(trouble, at);
  }
  // Its position is told by ours.
  static const std::regex position(R"((,? found)? at (expression )?position \d+|[.!]$)");
  std::string trouble = std::regex_replace(error.GetMsg(), position, "");
  trouble[0] = char(std::tolower(static_cast<unsigned char>(trouble[0])));
  throw ExpressionError(trouble, at);
}

// The text with the values of constants in the place of their names.
std::string with_values(const std::string& text, const std::map<std::string, double>& constants) {
  static const std::regex words(R"((\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[A-Za-z_]\w*)");
  std::ostringstream replaced;
  replaced << std::setprecision(17);
  std::size_t at = 0;
  for (std::sregex_iterator word(text.begin(), text.end(), words), end; word != end; ++word) {
    const auto constant = constants.find(word->str());
    if (constant == constants.end()) continue;
    replaced << text.substr(at, std::size_t(word->position()) - at) << "(" << constant->second << ")";
    at = std::size_t(word->position() + word->length());
  }
  return replaced.str() + text.substr(at);
}

// muParser takes "x = 3" for an assignment and "1, 2" for two results.
void refuse_assignments(const std::string& text) {
  const auto is_one_of = [&](std::size_t i, const char* some) {
    return i < text.size() && std::string(some).find(text[i]) != std::string::npos;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    if (is_one_of(i + 1, "="))
      ++i;
    else if (i == 0 || !is_one_of(i - 1, "<>!"))
      throw ExpressionError("assigns a value; expected == for a comparison", i);
  }
}

}  // namespace

bool is_free_name(const std::string& name) {
  if (name.empty() || name_at(name, 0) != name || name == "pi" || std::ranges::find(names, name) != names.end())
    return false;
  const mu::Parser parser;
  return !parser.GetFunDef().contains(name) && !parser.GetConst().contains(name);
}

struct Field::Function {
  std::string text;
  FieldUse use;
  std::array<double, names.size()> values{};
  std::array<bool, names.size()> used{};
  std::vector<double> named;  // of use.functions, where those that it does not name are null
  mu::Parser parser;
  std::mutex mutex;  // of values and parser
};

Field::Field(const std::string& text, const FieldUse& use) : constant_(1), function_(std::make_shared<Function>()) {
  Function& f = *function_;
  f.text = use.constants.empty() ? text : with_values(text, use.constants);
  f.use = use;
  if (text.size() > longest_expression) throw ExpressionError("longer than 1000 characters", longest_expression);
  refuse_assignments(text);
  try {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (i != s_ || use.on_curve) f.parser.DefineVar(names[i], &f.values[i]);
    f.parser.DefineConst("pi", std::numbers::pi);
    for (const auto& [constant, value] : use.constants) f.parser.DefineConst(constant, value);
    f.named.resize(use.functions.size());
    for (std::size_t i = 0; i < f.named.size(); ++i) f.parser.DefineVar(use.functions[i]->name, &f.named[i]);
    f.parser.SetExpr(text);
    f.parser.Eval();
    const auto& used = f.parser.GetUsedVar();
    for (std::size_t i = 0; i < names.size(); ++i) f.used[i] = used.contains(names[i]);
    for (std::size_t i = 0; i < f.named.size(); ++i)
      if (!used.contains(use.functions[i]->name)) f.use.functions[i] = nullptr;
  } catch (const mu::ParserError& error) {
    fail_parsing(text, error, use);
  }
  if (f.parser.GetNumResults() != 1) throw ExpressionError("has a comma; expected one value", text.find(','));
  if (use.constants.empty() || !f.parser.GetUsedVar().empty()) return;
  constant_ = f.parser.Eval();  // of constants alone
  function_.reset();
}

double Field::constant() const {
  assert(is_constant());
  return constant_;
}

Field Field::times(double factor) const {
  Field product = *this;
  product.constant_ *= factor;
  return product;
}

bool Field::uses_arc_length() const { return function_ && function_->used[s_]; }

double Field::value_at(const Vec2& x, double s) const {
  Function& f = *function_;
  double value = 0;
  {
    const std::lock_guard lock(f.mutex);
    f.values = {x.x(), x.y(), f.used[r_] ? x.norm() : 0, f.used[theta_] ? std::atan2(x.y(), x.x()) : 0, s};
    for (std::size_t i = 0; i < f.named.size(); ++i)
      if (f.use.functions[i]) f.named[i] = f.use.functions[i]->at(x);
    value = constant_ * f.parser.Eval();
  }
  if (std::abs(value) <= f.use.largest) return value;
  std::ostringstream text;
  text << f.use.key << ": '" << words() << "' is ";
  if (std::isnan(value))
    text << "not a number";
  else
    text << value;
  text << " " << near_point(x) << "; expected " << (std::isfinite(value) ? f.use.limit : "a finite value");
  throw SceneError(text.str());
}

std::string Field::words() const {
  std::ostringstream text;
  if (!function_)
    text << constant_;
  else if (constant_ == 1)
    text << printable(function_->text);
  else
    text << constant_ << " * (" << printable(function_->text) << ")";
  return text.str();
}

bool Field::same_function(const Field& other) const {
  if (!function_ || !other.function_) return !function_ && !other.function_;
  return function_->text == other.function_->text;
}

}  // namespace mortise
