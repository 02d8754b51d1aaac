// The heap in the processor's large pages, kept until the process ends.
#pragma once

namespace mortise {

/// Tells glibc to take blocks of up to 32 MB from one heap, of which the first gigabyte is in large pages (2 MB on
/// x86-64), and to keep what is freed. A program that factorises touches fresh memory all the time, and each page of
/// 4 KB that it touches first is an interruption: up to half of all time in a virtual machine. For main(), before the
/// first large block: the heap is the whole process's. Nothing with another C library, nor where the address space is
/// limited (ulimit -v), of which a gigabyte would be reserved.
void use_large_pages();

}  // namespace mortise
