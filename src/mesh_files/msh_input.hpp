// The text of a .msh, read number by number. An unexpected value throws InputError with file, line (byte in binary
// files) and section.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mortise {

/// Reads forward. In text a record, such as a node, stands on a line of its own; in binary files numbers follow one
/// another without anything between them.
class MshInput {
 public:
  /// Reads the whole file into memory. Throws InputError if it cannot be read.
  explicit MshInput(std::string file);

  const std::string& file() const { return file_; }
  bool binary() const { return binary_; }
  void set_binary(bool binary) { binary_ = binary; }
  /// For messages: the section that is being read, such as "$Nodes".
  void set_section(std::string section) { section_ = std::move(section); }
  const std::string& section() const { return section_; }

  /// The beginning of the record being read, for fail_at.
  std::size_t record() const { return record_; }
  [[noreturn]] void fail(const std::string& trouble) const { fail_at(record_, trouble); }
  [[noreturn]] void fail_at(std::size_t record, const std::string& trouble) const;

  /// Goes to the next record: in text over blanks and line breaks.
  void begin_record();
  /// In text the line must end here.
  void end_record();
  /// In text the line must end here, and the line break is passed: what follows may be binary.
  void end_line();

  /// The next number. In binary files an int of 4 bytes, or (`size`) one of 8; `real` a double. In text it must stand
  /// on the same line. Numbers that are not finite are refused.
  std::int64_t integer(const char* what);
  std::int64_t size(const char* what);
  double real(const char* what);
  /// The number of things that follow, each of at least that many bytes: refused where the file cannot hold so many.
  std::int64_t count(const char* what, std::size_t text_bytes, std::size_t binary_bytes);

  /// The same alone on a line, which is text in both kinds of files.
  std::int64_t count_line(const char* what, std::size_t text_bytes, std::size_t binary_bytes);

  /// Text in both kinds of files: the next line, without its end; empty lines are skipped. False at the end of the
  /// file.
  bool next_line(std::string_view& line);
  /// The same with empty lines, and the blanks around what stands there.
  bool next_whole_line(std::string_view& line);
  /// Whether the next line that is not empty is `line`; then it is passed. For "$EndNodes".
  bool at_line(std::string_view line);
  /// Passes everything up to the line `line`. False if there is none.
  bool skip_to(const std::string& line);

 private:
  [[noreturn]] void fail_token(const char* what) const;
  void skip_blanks();
  bool at_end_of_token() const;
  template <typename T>
  T raw(const char* what);
  std::int64_t text_integer(const char* what);

  std::string file_, text_, section_;
  std::size_t at_ = 0, record_ = 0;
  bool binary_ = false;
};

}  // namespace mortise
