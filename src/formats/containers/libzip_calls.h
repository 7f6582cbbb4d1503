// libzip's functions, as its module passes them.
#pragma once

#include <zip.h>

namespace ombre::formats {

struct LibzipCalls {
  // Functions of archives.
  decltype(&zip_open) open = zip_open;
  decltype(&zip_open_from_source) open_from_source = zip_open_from_source;
  decltype(&zip_close) close = zip_close;
  decltype(&zip_discard) discard = zip_discard;
  decltype(&zip_get_error) get_error = zip_get_error;
  decltype(&zip_strerror) strerror = zip_strerror;

  // These functions work on the entries of an archive.
  decltype(&zip_get_num_entries) get_num_entries = zip_get_num_entries;
  decltype(&zip_get_name) get_name = zip_get_name;
  decltype(&zip_stat_index) stat_index = zip_stat_index;
  decltype(&zip_stat_init) stat_init = zip_stat_init;
  decltype(&zip_fopen_index) fopen_index = zip_fopen_index;
  decltype(&zip_fread) fread = zip_fread;
  decltype(&zip_fclose) fclose = zip_fclose;
  decltype(&zip_file_strerror) file_strerror = zip_file_strerror;
  decltype(&zip_file_add) file_add = zip_file_add;
  decltype(&zip_file_set_dostime) file_set_dostime = zip_file_set_dostime;
  decltype(&zip_file_get_external_attributes) file_get_external_attributes = zip_file_get_external_attributes;
  decltype(&zip_set_file_compression) set_file_compression = zip_set_file_compression;

  // Functions of sources of bytes.
  decltype(&zip_source_buffer_create) source_buffer_create = zip_source_buffer_create;
  decltype(&zip_source_function) source_function = zip_source_function;
  decltype(&zip_source_make_command_bitmap) source_make_command_bitmap = zip_source_make_command_bitmap;
  decltype(&zip_source_free) source_free = zip_source_free;

  // Functions of errors.
  decltype(&zip_error_init) error_init = zip_error_init;
  decltype(&zip_error_init_with_code) error_init_with_code = zip_error_init_with_code;
  decltype(&zip_error_fini) error_fini = zip_error_fini;
  decltype(&zip_error_code_system) error_code_system = zip_error_code_system;
  decltype(&zip_error_system_type) error_system_type = zip_error_system_type;
  decltype(&zip_error_strerror) error_strerror = zip_error_strerror;
  decltype(&zip_error_to_data) error_to_data = zip_error_to_data;
};

}  // namespace ombre::formats

extern "C" const ombre::formats::LibzipCalls* ombre_libzip_calls();
