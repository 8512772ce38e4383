#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace touchdown {

/// What a program ends with.
enum ExitCode : int { good = 0, failed = 1, wrong_request = 2 };

/// To be called before a file is opened: standard streams that are closed become ones that give
/// nothing, swallow messages and refuse results, so that no file takes their place and gets what
/// was meant for them.
void open_standard_streams();

/// Prints on standard output. What cannot be written is `finished`'s to complain about: the work
/// that is told about goes on.
void print(std::string_view text);

/// Says on standard error what is wrong; returns `code`.
int complain(const std::string& message, ExitCode code);

/// A whole program: what `work` returns, unless there was not enough memory for it, or what it
/// printed on standard output could not be written, which it complains about.
int finished(const std::function<int()>& work);

}  // namespace touchdown
