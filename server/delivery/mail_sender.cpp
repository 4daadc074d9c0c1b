#include "server/delivery/mail_sender.hpp"

#include "server/delivery/mail_message.hpp"
#include "server/delivery/transfer.hpp"

namespace raywatch {
namespace {

std::string url_of(const MailSettings& settings) {
  const std::string host = settings.host.find(':') == std::string::npos ? settings.host : "[" + settings.host + "]";
  return (settings.security == MailSecurity::tls ? "smtps://" : "smtp://") + host + ":" + std::to_string(settings.port);
}

}  // namespace

SendResult MailSender::send(const Message& message, const std::stop_token& stop) {
  SenderConfig direct = config_;
  direct.proxy.clear();  // it is for HTTP
  Transfer transfer(url_of(settings_), "smtp,smtps", direct);
  if (settings_.security == MailSecurity::starttls) transfer.require_starttls();
  if (!settings_.user.empty()) transfer.log_in(settings_.user, settings_.password);
  transfer.mail(settings_.from, settings_.to, mail_message(settings_, message));
  const TransferEnd end = transfer.run(stop);
  SendResult result{.delivered = end.complete, .interrupted = end.interrupted};
  if (end.response_code != 0) result.response_code = end.response_code;
  if (!end.complete) result.error = end.error;
  return result;
}

}  // namespace raywatch
