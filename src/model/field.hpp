// A constant of the scene that may vary with the place: a number, or an expression.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "base/types.hpp"

namespace mortise {

/// An expression that is none.
class ExpressionError : public std::runtime_error {
 public:
  ExpressionError(const std::string& trouble, std::size_t at) : std::runtime_error(trouble), position(at) {}
  std::size_t position;  ///< where in the text, in bytes from 0
};

/// A function of place that expressions may name. They hold on to it, so `at` may be set after they are read.
struct NamedFunction {
  std::string name;
  std::function<double(const Vec2&)> at;
};

/// Whether expressions may have it for a name: letters, digits and _, not one of their own names or functions.
bool is_free_name(const std::string& name);

/// Where an expression stands, and what it may be.
struct FieldUse {
  std::string key;                                      ///< "boundary.2.pressure (line 31)", for messages
  bool on_curve = false;                                ///< whether it may name s
  double largest = std::numeric_limits<double>::max();  ///< of its size
  std::string limit = {};  ///< "a load below every Young's modulus": what `largest` is, for messages
  std::vector<std::shared_ptr<const NamedFunction>> functions = {};  ///< that it may name
  std::map<std::string, double> constants = {};                      ///< likewise; its text then has their values
};

/// A number, or a function of x and y (undeformed), r and theta (polar, about the origin), and on a curve s (its arc
/// length, docs/notation.md), and of the functions of its use. A number costs what a number does. Copies share the
/// expression, which several threads may ask at the same time.
class Field {
 public:
  Field(double constant = 0) : constant_(constant) {}
  /// Throws ExpressionError.
  Field(const std::string& expression, const FieldUse& use);

  /// Throws SceneError, with key and place, where the value is not finite or larger than `largest`.
  double operator()(const Vec2& x, double s = 0) const { return function_ ? value_at(x, s) : constant_; }

  Field times(double factor) const;

  bool is_constant() const { return !function_; }
  /// Only of one that is constant.
  double constant() const;
  bool uses_arc_length() const;
  /// The number by six digits, or the expression as the user wrote it.
  std::string words() const;

  friend bool operator==(const Field& a, const Field& b) { return a.constant_ == b.constant_ && a.same_function(b); }

 private:
  struct Function;
  double value_at(const Vec2& x, double s) const;
  bool same_function(const Field& other) const;

  double constant_ = 0;                 // of a function a factor
  std::shared_ptr<Function> function_;  // none: constant_
};

/// Two of them.
struct VectorField {
  Field x, y;

  VectorField() = default;
  VectorField(const Vec2& constant) : x(constant.x()), y(constant.y()) {}
  VectorField(Field first, Field second) : x(std::move(first)), y(std::move(second)) {}

  Vec2 operator()(const Vec2& at, double s = 0) const { return {x(at, s), y(at, s)}; }
  bool is_constant() const { return x.is_constant() && y.is_constant(); }
  bool uses_arc_length() const { return x.uses_arc_length() || y.uses_arc_length(); }
  bool operator==(const VectorField&) const = default;
};

}  // namespace mortise
