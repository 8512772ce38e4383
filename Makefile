# Thin: the build is CMake's, the packages are apt's, the rest is in scripts/.
JOBS ?= $(shell nproc)
BUILD := build/release

.DEFAULT_GOAL := help
.PHONY: help setup build run trainer everything test lint format bench asan clean

help: ## Show this list
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 16

setup: ## Install every Debian package that is missing
	@scripts/install_packages.sh

# Configured once; from then on ninja itself notices when a CMakeLists.txt changes.
build: ## Build the program alone: build/release/touchdown
	@scripts/install_packages.sh program
	@test -e $(BUILD)/build.ninja || cmake --preset program
	cmake --build --preset program --parallel $(JOBS) --target touchdown

run: build ## Build the program, then run the first experiment
	$(BUILD)/touchdown run experiments/stairs.yaml

trainer: ## Build the program and the trainer of the neural network
	@scripts/install_packages.sh program trainer
	@grep -qs '^TOUCHDOWN_TRAINER:.*=ON' $(BUILD)/CMakeCache.txt || cmake --preset program -DTOUCHDOWN_TRAINER=ON
	cmake --build --preset program --parallel $(JOBS) --target touchdown touchdown-train

everything: ## Build the program, the trainer, the tests and the benchmarks
	@scripts/install_packages.sh program trainer tests
	@grep -qs '^TOUCHDOWN_TESTS:.*=ON' $(BUILD)/CMakeCache.txt || cmake --preset release
	cmake --build --preset release --parallel $(JOBS)

test: everything ## Build everything and run every test
	ctest --preset release --parallel $(JOBS)

lint: ## Check formatting, clang-tidy and the shell scripts
	@scripts/install_packages.sh
	@grep -qs '^TOUCHDOWN_TESTS:.*=ON' $(BUILD)/CMakeCache.txt || cmake --preset release
	@cmake --build --preset release --target build.ninja >/dev/null # up to date with the lists
	@JOBS=$(JOBS) scripts/lint.sh $(BUILD)

format: ## Format every source file
	@scripts/install_packages.sh lint
	git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format -i

bench: everything ## Run every benchmark
	@for program in $(BUILD)/bench_*; do echo "$$program"; "$$program" || exit 1; done

asan: ## Build and test with AddressSanitizer and UBSan
	@scripts/install_packages.sh program trainer tests
	@test -e build/asan/build.ninja || cmake --preset asan
	cmake --build --preset asan --parallel $(JOBS)
	ctest --preset asan --parallel $(JOBS)

clean: ## Remove what was built (runs/ stays)
	rm -rf build
