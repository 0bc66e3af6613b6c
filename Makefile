# `make demo` shows a simulated vehicle, `make test` proves the driver. Both install what they need.
SHELL := /bin/bash
# A program that drives the vehicle: square or square_cpp (a kingfisher), survey (a sandshark), dive or
# square (a blueye), none.
EXAMPLE ?= none
VEHICLE ?= $(if $(filter square%,$(EXAMPLE)),kingfisher,$(if $(filter dive,$(EXAMPLE)),blueye,sandshark))
# Another folder for everything that is built: make BUILD_DIR=/tmp/build test
BUILD_DIR ?= build
export BUILD_DIR
# Simulated missions.
SEEDS ?= 10000
# Compilers at once.
JOBS ?= 2
export JOBS

# Of the soak; of each simulated mission.
HOURS ?= 1
# For each fuzzer.
FUZZ_SECONDS ?= 60

.DEFAULT_GOAL := help
.PHONY: help demo test replay-test build pictures coverage fuzz sanitize netns-test sdk-test soak simulate plant mutate lint bench clean

help: ## what there is to make
	@sed -n 's/^\([a-z-]*\):.*## /  make \1	/p' Makefile | expand -t 20

demo: ## a simulated vehicle and its driver, in rviz if there is a display; VEHICLE=sandshark|kingfisher|blueye, EXAMPLE=square|square_cpp|survey|dive
	@scripts/install_dependencies build $(if $(DISPLAY),rviz)
	@scripts/build -DCATKIN_ENABLE_TESTING=OFF -DFRONTSEAT_QUICK_BUILD=ON
	@scripts/demo "$(VEHICLE)" "$(EXAMPLE)"

test: ## builds with warnings as errors and runs all tests; closes with "N passed, M failed"
	@scripts/install_dependencies build test
	@TARGETS="all tests" scripts/build -DCATKIN_ENABLE_TESTING=ON -DFRONTSEAT_WARNINGS_AS_ERRORS=ON -DFRONTSEAT_QUICK_BUILD=ON
	@scripts/run_tests

replay-test: ## records ten-minute missions in real time and replays them at 1x, 10x and unlimited rate
	@scripts/install_dependencies build test
	@scripts/build
	@scripts/replay_test

build: ## the package, ready to be sourced from build/devel/setup.bash
	@scripts/install_dependencies build test
	@scripts/build

fuzz: ## FUZZ_SECONDS=60 of libFuzzer on each target, or FUZZER=decode alone; KEEP=1 adds what is new to the corpora
	@scripts/install_dependencies build test fuzz
	@BUILD_DIR="$(BUILD_DIR)/fuzz" TARGETS=fuzzers scripts/build -DCMAKE_CXX_COMPILER=clang++ -DCATKIN_ENABLE_TESTING=ON -DFRONTSEAT_FUZZERS=ON -DFRONTSEAT_QUICK_BUILD=ON
	@BUILD_DIR="$(BUILD_DIR)/fuzz" scripts/fuzz "$(FUZZ_SECONDS)" $(FUZZER)

coverage: ## lines and branches that the test programs reach, by layer
	@scripts/install_dependencies build test coverage
	@scripts/coverage

netns-test: ## real network faults between network namespaces; needs root
	@scripts/install_dependencies build test netns
	@scripts/build
	@scripts/netns_test

sdk-test: ## the vendor's Python SDK with the simulated Blueye and beside the driver; needs root, PYTHON=one with blueye.sdk
	@scripts/install_dependencies build test netns
	@scripts/build
	@scripts/sdk_test

soak: ## HOURS=1 of a boat behind a link that breaks; memory, threads and sentences are counted
	@scripts/install_dependencies build test soak
	@scripts/build
	@scripts/soak "$(HOURS)"

sanitize: ## the test programs under address, undefined behavior and thread sanitizers
	@scripts/install_dependencies build test
	@scripts/sanitize

pictures: build ## the README's plots and monitor, from demo missions of five minutes
	@scripts/pictures

bench: ## what a sentence costs, beside baselines, as doc/performance.md explains; BENCH=full takes half an hour
	@scripts/install_dependencies build bench
	@scripts/build -DFRONTSEAT_BENCH=ON
	@scripts/bench $(BENCH)

simulate: ## missions in virtual time on all cores, any fault from a seed; SEEDS=10000, HOURS=1 each
	@scripts/install_dependencies build test
	@TARGETS="mission_simulation blueye_mission_simulation" scripts/build -DCATKIN_ENABLE_TESTING=ON
	@"$(BUILD_DIR)/devel/lib/frontseat_driver/mission_simulation" --seeds=$(SEEDS) --hours=$(HOURS)
	@"$(BUILD_DIR)/devel/lib/frontseat_driver/blueye_mission_simulation" --seeds=$(SEEDS)

plant: ## plants bugs in a copy of the sources and shows that missions find each; SEEDS=100
	@scripts/install_dependencies build test
	@SEEDS=$(if $(filter file,$(origin SEEDS)),100,$(SEEDS)) HOURS=$(HOURS) scripts/plant_bugs

mutate: ## gets one sign, scale, axis, time or comparison wrong at a time and expects a test to notice; FILES='src/ros/*'
	@scripts/install_dependencies build test mutate
	@scripts/mutate $(FILES)

lint: ## clang-format, catkin_lint, cppcheck and clang-tidy over everything; takes long
	@scripts/install_dependencies build test bench lint
	@BUILD_DIR="$(BUILD_DIR)/lint" TARGETS="frontseat_driver_generate_messages_cpp blueye_proto" scripts/build -DCATKIN_ENABLE_TESTING=ON -DFRONTSEAT_BENCH=ON -DFRONTSEAT_QUICK_BUILD=ON -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
	@BUILD_DIR="$(BUILD_DIR)/lint" scripts/lint

clean: ## removes everything that was built
	rm -rf "$(BUILD_DIR)"
