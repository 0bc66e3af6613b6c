# Not a component of catkin, which would link every other library with it.
find_package(rosbag_storage REQUIRED)

# What prints and counts is a library of its own, so that tests need no program.
add_library(${PROJECT_NAME}_decode STATIC
  decode/ack_round_trips.cpp
  decode/bag_reader.cpp
  decode/csv_output.cpp
  decode/decoded_line.cpp
  decode/fault_note.cpp
  decode/field_text.cpp
  decode/json_output.cpp
  decode/line_output.cpp
  decode/options.cpp
  decode/output.cpp
  decode/plot.cpp
  decode/progress.cpp
  decode/record.cpp
  decode/selection.cpp
  decode/summary.cpp
  decode/summary_text.cpp
)
add_dependencies(${PROJECT_NAME}_decode ${${PROJECT_NAME}_EXPORTED_TARGETS})
target_include_directories(${PROJECT_NAME}_decode SYSTEM PRIVATE
  ${CLI11_INCLUDE_DIR}
  ${rosbag_storage_INCLUDE_DIRS}
)
target_link_libraries(${PROJECT_NAME}_decode PUBLIC
  ${PROJECT_NAME}_capture
  ${PROJECT_NAME}_conversions
  ${rosbag_storage_LIBRARIES}
)

add_executable(nmea_decode decode/nmea_decode.cpp)
target_link_libraries(nmea_decode PRIVATE ${PROJECT_NAME}_decode)

install(TARGETS nmea_decode RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
