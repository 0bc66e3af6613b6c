find_path(CLI11_INCLUDE_DIR CLI/CLI.hpp)
if(NOT CLI11_INCLUDE_DIR)
  message(FATAL_ERROR "CLI11 was not found; install libcli11-dev")
endif()

add_executable(nmea_simulator
  simulator_arguments.cpp
  simulator_main.cpp
  simulator_ros.cpp
)
target_include_directories(nmea_simulator SYSTEM PRIVATE
  ${CLI11_INCLUDE_DIR}
  ${catkin_INCLUDE_DIRS}
)
target_link_libraries(nmea_simulator PRIVATE
  ${PROJECT_NAME}_sim
  ${catkin_LIBRARIES}
)

install(TARGETS nmea_simulator RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
