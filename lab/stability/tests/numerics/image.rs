//! Camera, picture, and the whole scene.

super::cases! {
    case_53_pictures_of_one_row_or_column,
    case_54_picture_of_width_65535,
    case_55_telephoto_lens,
    case_56_field_of_view_of_179_9_degrees,
    case_57_schedules,
    case_58_translation_of_the_scene,
    case_59_scale_by_powers_of_two,
    case_60_mirror_in_x,
    case_61_permuted_objects,
}
