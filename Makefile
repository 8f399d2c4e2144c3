# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: The SLAMBench authors
#
# The short way in; everything below is CMake and ctest, which can be used directly as well.

JOBS ?= $(shell nproc 2>/dev/null || echo 2)
PREFIX ?= /usr/local
INSTALL ?= yes
ARGS ?=

.PHONY: help run paper test asan tsan aarch64 tidy install build dependencies clean
.DEFAULT_GOAL := help

help: ## show this
	@echo "make run        set up, build, and benchmark the built-in sequence"
	@echo "                (ARGS='path/to/recording -c 2' runs something else)"
	@echo "make paper      set up, build, run the experiment of the SLAMBench paper (some 25"
	@echo "                minutes on two cores), and make its report, in OUT=results/paper"
	@echo "make test       set up, build, and run all tests"
	@echo "make asan       the tests under AddressSanitizer and UndefinedBehaviourSanitizer"
	@echo "make tsan       the agreement tests under ThreadSanitizer"
	@echo "make aarch64    the agreement tests, built for 64-bit ARM and emulated"
	@echo "make tidy       clang-tidy on every source file (some ten minutes on two cores)"
	@echo "make install    install to PREFIX ($(PREFIX)); DESTDIR is respected"
	@echo "make clean      remove build/; results/ stays"
	@echo
	@echo "INSTALL=no leaves out the installation of missing Debian packages; JOBS=N limits"
	@echo "the processes of the build (now $(JOBS))."

dependencies:
ifneq ($(INSTALL),no)
	@scripts/install_dependencies
endif

build: dependencies
	@cmake --preset release
	@cmake --build --preset release --parallel $(JOBS)

# Without the tests, which take longer to build than the program.
run: dependencies
	@cmake --preset release
	@cmake --build --preset release --parallel $(JOBS) --target slambench
	@build/release/apps/slambench/slambench run $(ARGS)

# Goes on where it was interrupted. OUT=results/try ARGS=--frames=50 tries it out.
paper: OUT = results/paper
paper: dependencies
	@cmake --preset release
	@cmake --build --preset release --parallel $(JOBS) --target slambench
	@build/release/apps/slambench/slambench suite configs/paper.toml --out "$(OUT)" $(ARGS)
ifeq ($(filter --dry-run,$(ARGS)),)
	@build/release/apps/slambench/slambench report "$(OUT)" -o "$(OUT)/report.html"
endif

test: build
	@ctest --preset release --parallel $(JOBS)

asan: dependencies
	@cmake --preset asan
	@cmake --build --preset asan --parallel $(JOBS)
	@ctest --preset asan --parallel $(JOBS)

tsan: dependencies
	@cmake --preset tsan
	@cmake --build --preset tsan --parallel $(JOBS)
	@ctest --preset tsan --parallel $(JOBS)

aarch64:
ifneq ($(INSTALL),no)
	@scripts/install_dependencies aarch64
endif
	@cmake --preset aarch64
	@cmake --build --preset aarch64 --parallel $(JOBS)
	@ctest --preset aarch64 --parallel $(JOBS)

tidy: dependencies
	@cmake --preset release
	@cmake --build --preset release --parallel $(JOBS)
	@git ls-files 'src/*.cpp' 'apps/*.cpp' | xargs --max-procs=$(JOBS) --max-args=1 \
	  clang-tidy --quiet --extra-arg=-Wno-unknown-warning-option -p build/release

# Not after `build`: under sudo, nothing of it shall be written as root.
install:
	@test -x build/release/apps/slambench/slambench || \
	  { echo "make install: build first, with 'make run' or 'make test'" >&2; exit 1; }
	@cmake --install build/release --prefix $(PREFIX)

clean:
	@cmake -E rm -rf build
