// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/error.h"

#include <utility>

namespace toile {

std::string_view error_name(ErrorCode code) {
  switch (code) {
    case ErrorCode::BadUsage: return "bad_usage";
    case ErrorCode::FileUnreadable: return "file_unreadable";
    case ErrorCode::FormatUnknown: return "format_unknown";
    case ErrorCode::FileMalformed: return "file_malformed";
    case ErrorCode::LimitExceeded: return "limit_exceeded";
    case ErrorCode::OptionInvalid: return "option_invalid";
    case ErrorCode::BodyUnusable: return "body_unusable";
    case ErrorCode::BodyNotRecognised: return "body_not_recognised";
    case ErrorCode::GarmentInvalid: return "garment_invalid";
    case ErrorCode::SeamInvalid: return "seam_invalid";
    case ErrorCode::RegistrationFailed: return "registration_failed";
    case ErrorCode::DrapeFailed: return "drape_failed";
    case ErrorCode::DerivationFailed: return "derivation_failed";
    case ErrorCode::AlterationFailed: return "alteration_failed";
    case ErrorCode::Cancelled: return "cancelled";
    case ErrorCode::TimedOut: return "timed_out";
    case ErrorCode::ResourceLimit: return "resource_limit";
    case ErrorCode::StorageFull: return "storage_full";
    case ErrorCode::StorageFailed: return "storage_failed";
    case ErrorCode::Crashed: return "crashed";
    case ErrorCode::NotFound: return "not_found";
    case ErrorCode::Conflict: return "conflict";
    case ErrorCode::Unauthorized: return "unauthorized";
    case ErrorCode::QueueFull: return "queue_full";
    case ErrorCode::Internal: return "internal";
  }
  return "internal";
}

int exit_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::BadUsage:
    case ErrorCode::OptionInvalid: return 2;
    case ErrorCode::FileUnreadable:
    case ErrorCode::FormatUnknown:
    case ErrorCode::FileMalformed:
    case ErrorCode::LimitExceeded:
    case ErrorCode::BodyUnusable:
    case ErrorCode::BodyNotRecognised:
    case ErrorCode::GarmentInvalid:
    case ErrorCode::SeamInvalid: return 3;
    case ErrorCode::RegistrationFailed:
    case ErrorCode::DrapeFailed:
    case ErrorCode::DerivationFailed:
    case ErrorCode::AlterationFailed:
    case ErrorCode::TimedOut:
    case ErrorCode::ResourceLimit:
    case ErrorCode::StorageFull:
    case ErrorCode::StorageFailed:
    case ErrorCode::Crashed: return 4;
    case ErrorCode::Cancelled: return 5;
    default: return 70;
  }
}

Error::Error(ErrorCode code_, std::string subject_, std::string message_)
    : code(code_), subject(std::move(subject_)), message(std::move(message_)) {
  text_ = subject.empty() ? message : subject + ": " + message;
}

}  // namespace toile
