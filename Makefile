# A thin front end: CMake builds, apt installs the packages, scripts/ does the rest.
JOBS ?= $(shell nproc)
BUILD := build/release

.DEFAULT_GOAL := help
.PHONY: help setup program-packages trainer-packages viewer-packages python-packages test-packages nightly-packages lint-packages \
	fuzz-packages build run trainer viewer python everything test configure-nightly nightly nightly-viewer nightly-training faults package lint format bench results figures asan tsan fuzz clean

help: ## Show this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 24

setup: ## Install every Debian package that is missing
	@scripts/install_packages.sh

program-packages:
	@scripts/install_packages.sh program
trainer-packages:
	@scripts/install_packages.sh program trainer
viewer-packages:
	@scripts/install_packages.sh program viewer
python-packages:
	@scripts/install_packages.sh program python
lint-packages:
	@scripts/install_packages.sh program trainer viewer python tests nightly lint
fuzz-packages:
	@scripts/install_packages.sh lint
test-packages:
	@scripts/install_packages.sh program python tests
nightly-packages:
	@scripts/install_packages.sh program trainer viewer python tests nightly $(if $(wildcard /run/systemd/system),,servers)

# Configured once; afterwards ninja itself notices changes of a CMakeLists.txt. Each target is a file
# that only a successful configuration writes: of the program, of a part of its own, of the tests.
configured = $(BUILD)/$(1)/cmake_install.cmake

$(BUILD)/build.ninja: | program-packages
	cmake --preset program
$(call configured,training): | trainer-packages $(BUILD)/build.ninja
	cmake $(BUILD) -DTOUCHDOWN_TRAINER=ON
$(call configured,viewer): | viewer-packages $(BUILD)/build.ninja
	cmake $(BUILD) -DTOUCHDOWN_VIEWER=ON
$(call configured,python): | python-packages $(BUILD)/build.ninja
	cmake $(BUILD) -DTOUCHDOWN_PYTHON=ON
$(BUILD)/CTestTestfile.cmake: CMakePresets.json | test-packages
	cmake --preset release
	@touch $@
build/package/build.ninja: CMakePresets.json
	@scripts/install_packages.sh program python package
	cmake --preset package
	@touch $@

build/asan/build.ninja: CMakePresets.json | nightly-packages
	cmake --preset asan
	@touch $@

build/tsan/build.ninja: CMakePresets.json | nightly-packages
	cmake --preset tsan
	@touch $@

build/fuzz/build.ninja: CMakePresets.json | test-packages fuzz-packages
	cmake --preset fuzz
	@touch $@

build: $(BUILD)/build.ninja ## Build the program alone: build/release/touchdown
	@echo "== compiling what is new of the program: three to four minutes on two cores the first time"
	@NINJA_STATUS="compiling %f of %t, %e s: " cmake --build --preset program --parallel $(JOBS) --target touchdown

run: build ## Build the program, then run the first experiment
	@echo "== the first experiment: simulate, fit, evaluate, score, draw, film: a minute or two on two cores"
	$(BUILD)/touchdown run experiments/stairs.yaml

trainer: $(call configured,training) ## Build the program and the trainer of the neural network
	cmake --build --preset program --parallel $(JOBS) --target touchdown touchdown-train

viewer: $(call configured,viewer) ## Build the program and the window of `touchdown watch`
	cmake --build --preset program --parallel $(JOBS) --target touchdown touchdown-watch

python: $(call configured,python) ## Build the Python package: build/release/python
	cmake --build --preset program --parallel $(JOBS) --target touchdown_python

everything: $(BUILD)/CTestTestfile.cmake ## Build the program, the Python package and the tests
	cmake --build --preset release --parallel $(JOBS)

test: everything ## Build everything and run every test but the nightly ones
	ctest --preset release --parallel $(JOBS)

configure-nightly: | nightly-packages
	cmake --preset nightly

nightly: configure-nightly ## Run the rest: trainer, window, browser, faults, clusters, aarch64, installations, long draws
	cmake --build --preset nightly --parallel $(JOBS)
	ctest --preset nightly --parallel $(JOBS)

nightly-training: configure-nightly ## Run the nightly tests of the trainer
nightly-viewer: configure-nightly ## Run the nightly tests of the window
nightly-training nightly-viewer:
	cmake --build --preset nightly --parallel $(JOBS) --target test_$(@:nightly-%=%)
	ctest --preset nightly --tests-regex '^$(@:nightly-%=%)\.'

faults: configure-nightly ## Let each system call fail, fill the disk, kill the program in every stage
	cmake --build --preset nightly --parallel $(JOBS) --target test_faults
	@scripts/faults.sh $(BUILD)/test_faults $(JOBS)

package: build/package/build.ninja ## Build a Debian package that needs no compiler: build/package/touchdown_*.deb
	cmake --build --preset package --parallel $(JOBS) --target package

lint: lint-packages ## Check formatting, shell scripts, and with clang-tidy every source, or those changed SINCE a date
	@cmake --preset lint >/dev/null
	@JOBS=$(JOBS) scripts/lint.sh build/lint $(if $(SINCE),'$(SINCE)')

format: ## Format every source file
	@scripts/install_packages.sh lint
	git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format -i

bench: configure-nightly ## Build and run every benchmark
	cmake --build --preset nightly --parallel $(JOBS) --target benchmarks
	@for program in $(BUILD)/bench_*; do echo "$$program"; "$$program" || exit 1; done

results: build ## Run the commands of docs/results.md and compare its numbers: hours
	scripts/documents/results.py $(BUILD)/touchdown

figures: build ## Draw the pictures of docs/images again: half an hour
	scripts/documents/figures.py $(BUILD)/touchdown

asan: build/asan/build.ninja ## Build and test with AddressSanitizer and UBSan
	cmake --build --preset asan --parallel $(JOBS)
	ctest --preset asan --parallel $(JOBS)

tsan: build/tsan/build.ninja ## Build and test what runs in threads with ThreadSanitizer
	cmake --build --preset tsan --parallel $(JOBS)
	ctest --preset tsan --parallel $(JOBS)

fuzz: build/fuzz/build.ninja $(BUILD)/CTestTestfile.cmake ## Fuzz every reader of files, MINUTES (1) each, and every estimator
	cmake --build --preset fuzz --parallel $(JOBS)
	@scripts/fuzz.sh build/fuzz $(or $(MINUTES),1)
	cmake --build --preset release --parallel $(JOBS) --target test_experiments
	TOUCHDOWN_RANDOM_SEQUENCES=100000 $(BUILD)/test_experiments --gtest_filter='RandomSequences.*'

clean: ## Remove what was built (runs/ stays)
	rm -rf build
