# Thin: the build is CMake's, the packages are apt's, the rest is in scripts/.
JOBS ?= $(shell nproc)

.DEFAULT_GOAL := help
.PHONY: help setup build run test lint format bench asan clean

help: ## Show this list
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 16

setup: ## Install the Debian packages that are missing
	@scripts/install_packages.sh

# Configured once; from then on ninja itself notices when a CMakeLists.txt changes.
build/%/build.ninja: CMakePresets.json | setup
	cmake --preset $*
	@touch $@

build: build/release/build.ninja ## Build the program: build/release/touchdown
	cmake --build --preset release --parallel $(JOBS)

run: build ## Build, then run the first experiment
	build/release/touchdown run experiments/stairs.yaml

test: build ## Build and run every test
	ctest --preset release --parallel $(JOBS)

lint: build/release/build.ninja ## Check formatting, clang-tidy and the shell scripts
	@cmake --build --preset release --target build.ninja >/dev/null # up to date with the lists
	@JOBS=$(JOBS) scripts/lint.sh build/release

format: setup ## Format every source file
	git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format -i

bench: build ## Run every benchmark
	@for program in build/release/bench_*; do echo "$$program"; "$$program" || exit 1; done

asan: build/asan/build.ninja ## Build and test with AddressSanitizer and UBSan
	cmake --build --preset asan --parallel $(JOBS)
	ctest --preset asan --parallel $(JOBS)

clean: ## Remove what was built (runs/ stays)
	rm -rf build
