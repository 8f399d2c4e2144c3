// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>
#include <filesystem>

namespace slambench {

/// What Linux can hand out without swapping, or what is left of the limit of a control group that
/// the process is in (a container's), whichever is less; elsewhere the whole memory. An allocation
/// beyond it would succeed and the process be killed later. The system's files are looked for below
/// `root`.
std::size_t available_memory_bytes(const std::filesystem::path& root = "/");

/// Throws UnavailableError when the machine has less than that available.
void require_memory(std::size_t bytes);

/// Asks for huge pages for this memory, where the system has them; a wish.
void ask_for_huge_pages(void* data, std::size_t bytes);

}  // namespace slambench
